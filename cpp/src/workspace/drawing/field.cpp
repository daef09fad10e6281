#include "ninedof/workspace/field.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "math/stop_at_times.hpp"
#include "ninedof/math/error.hpp"
#include "workspace/drawing/raster.hpp"

namespace ninedof {
namespace {

/// The undivided cells that hold the workspace, and one more on each side, as a range of their numbers.
struct Window {
  Vec3 first, last;
};

Window window_of(const WorkspaceMap& map) {
  const Vec3 side = (map.high - map.low) / map.resolution, whole = Vec3::Constant(map.resolution);
  Vec3 low = Vec3::Constant(infinity), high = -low;
  for (std::size_t n = 0; n < map.cells.size(); ++n) {
    if (!(map.cells.fraction[n] > 0.0)) continue;
    const Vec3 centre = (map.cells.centre[n] - map.low).cwiseQuotient(side);
    const double half = std::ldexp(0.5, -map.cells.level[n]);
    low = low.cwiseMin((centre.array() - half + 1e-6).floor().matrix());
    high = high.cwiseMax((centre.array() + half - 1e-6).ceil().matrix());
  }
  if (!(low.x() <= high.x())) return {Vec3::Zero(), whole};
  return {(low.array() - 1.0).cwiseMax(0.0), (high.array() + 1.0).matrix().cwiseMin(whole)};
}

/// A cell in a window, measured in undivided cells from its lowest corner.
struct FieldCell {
  Vec3 centre;
  int level;
  bool boundary;
  double fraction, logarithm;  // of the condition number
};

std::vector<FieldCell> cells_in(const WorkspaceMap& map, const Window& window, const std::stop_token& stop) {
  std::vector<FieldCell> out;
  const WorkspaceCells& cells = map.cells;
  const Vec3 side = (map.high - map.low) / map.resolution, span = window.last - window.first;
  double worst = 1.0;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    stop_at_times(static_cast<long>(n), stop);
    // Wholly in the window, so that no cell, not even one of a damaged file, is written beyond the raster.
    const double half = std::ldexp(0.5 * (1.0 - 1e-6), -cells.level[n]);
    const Vec3 at = (cells.centre[n] - map.low).cwiseQuotient(side) - window.first;
    if (!(at.minCoeff() > half && (span - at).minCoeff() > half)) continue;
    const double kappa = cells.condition_number[n];
    if (std::isfinite(kappa)) worst = std::max(worst, kappa);
    out.push_back({at, cells.level[n], cells.state[n] == CellState::boundary, cells.fraction[n], std::log(kappa)});
  }
  for (FieldCell& cell : out)
    if (!std::isfinite(cell.logarithm)) cell.logarithm = std::log(worst);
  return out;
}

/// Both fields, one level after the other.
class Refinement {
 public:
  Refinement(const WorkspaceMap& map, const Window& window) {
    const Vec3 side = (map.high - map.low) / map.resolution;
    for (int axis = 0; axis < 3; ++axis)
      fraction_.count[at_index(axis)] = static_cast<std::size_t>(window.last[axis] - window.first[axis]);
    fraction_.values.assign(fraction_.count[0] * fraction_.count[1] * fraction_.count[2], 0.0);
    fraction_.step = side;
    fraction_.first = map.low + side.cwiseProduct(window.first + Vec3::Constant(0.5));
    logarithm_ = fraction_;
  }

  /// Sets the values where there are cells of a level; the means of smaller ones.
  void set(const std::vector<FieldCell>& cells, int level, const std::stop_token& stop) {
    struct Sum {
      double weight = 0.0, fraction = 0.0, logarithm = 0.0;
    };
    std::vector<Sum> sums(fraction_.values.size());
    for (std::size_t n = 0; n < cells.size(); ++n) {
      stop_at_times(static_cast<long>(n), stop);
      const FieldCell& cell = cells[n];
      if (cell.level >= level) {
        const double weight = std::ldexp(1.0, -3 * (cell.level - level));
        Sum& sum = sums[number(std::ldexp(1.0, level) * cell.centre)];
        sum.weight += weight;
        sum.fraction += weight * cell.fraction;
        sum.logarithm += weight * cell.logarithm;
      } else if (!cell.boundary) {  // wholly inside or outside: nothing to interpolate
        fill(cell, level);
      }
    }
    for (std::size_t n = 0; n < sums.size(); ++n) {
      if (!(sums[n].weight > 0.0)) continue;
      fraction_.values[n] = sums[n].fraction / sums[n].weight;
      logarithm_.values[n] = sums[n].logarithm / sums[n].weight;
    }
  }

  void refine() {
    fraction_ = refined(fraction_);
    logarithm_ = refined(logarithm_);
  }

  WorkspaceField result() const {
    WorkspaceField out{averaged(padded(fraction_, 0.0)), averaged(padded(logarithm_, {}))};
    for (double& value : out.condition_number.values) value = std::exp(value);
    return out;
  }

 private:
  std::size_t number(const Vec3& at) const {
    const auto stride = strides(fraction_.count);
    std::size_t out = 0;
    for (int axis = 0; axis < 3; ++axis) out += static_cast<std::size_t>(at[axis]) * stride[at_index(axis)];
    return out;
  }

  void fill(const FieldCell& cell, int level) {
    const auto side = std::size_t{1} << (level - cell.level);
    const Vec3 corner = (std::ldexp(1.0, level) * cell.centre).array() - 0.5 * static_cast<double>(side) + 0.5;
    double* from = &fraction_.values[number(corner)];
    for_each_point({side, side, side}, fraction_.count,
                   [&](std::size_t, std::size_t, std::size_t, std::size_t n) { from[n] = cell.fraction; });
  }

  Raster fraction_, logarithm_;
};

}  // namespace

WorkspaceField field_of(const WorkspaceMap& map, long most, const std::stop_token& stop) {
  if (map.resolution < 1) throw InvalidArgument("map", "no cells", "a map of an octree or a grid");
  const Window window = window_of(map);
  const std::vector<FieldCell> cells = cells_in(map, window, stop);
  Refinement fields(map, window);
  const int deepest = map.cells.level.empty() ? 0 : *std::ranges::max_element(map.cells.level);
  fields.set(cells, 0, stop);
  double points = 8.0 * (window.last - window.first).prod();
  for (int level = 1; level <= deepest && points <= static_cast<double>(most); ++level, points *= 8.0) {
    fields.refine();
    fields.set(cells, level, stop);
  }
  return fields.result();
}

QuadSurface surface_of(const WorkspaceField& field) {
  std::vector<double> values = field.fraction.values;
  double allowed = 0.0;
  for (const double value : values) allowed += value;
  if (values.empty()) return {};
  const auto above = std::clamp<std::ptrdiff_t>(std::lrint(allowed), 1, std::ssize(values));
  std::nth_element(values.begin(), values.begin() + above - 1, values.end(), std::greater<>());
  return surface_net(field.fraction, std::clamp(values[at_index(above - 1)], 0.15, 0.6), 0.0);
}

}  // namespace ninedof
