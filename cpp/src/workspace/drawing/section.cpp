/// Declared in ninedof/workspace/field.hpp.

#include <cmath>

#include "math/numbers.hpp"
#include "math/stop_at_times.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/workspace/field.hpp"
#include "workspace/criteria/limits.hpp"
#include "workspace/drawing/raster.hpp"

namespace ninedof {
namespace {

using Plane = Eigen::Array2d;  // along the horizontal and the vertical coordinate of a section

/// The two coordinates that are drawn where one is fixed.
struct Drawn {
  int horizontal, vertical;

  explicit Drawn(int fixed) : horizontal(fixed == 0 ? 1 : 0), vertical(fixed == 2 ? 1 : 2) {
    if (fixed < 0 || fixed > 2) throw InvalidArgument("fixed", std::to_string(fixed), "0, 1 or 2");
  }
  Plane of(const Vec3& x) const { return {x[horizontal], x[vertical]}; }
};

/// Nothing allowed, at `columns` x `rows` points from `first` on.
WorkspaceSection empty_section(const Plane& first, const Plane& step, std::size_t columns, std::size_t rows) {
  WorkspaceSection out;
  for (std::size_t n = 0; n < columns; ++n) out.horizontal.push_back(first[0] + step[0] * static_cast<double>(n));
  for (std::size_t n = 0; n < rows; ++n) out.vertical.push_back(first[1] + step[1] * static_cast<double>(n));
  out.state.assign(columns * rows, CellState::outside);
  out.limit.assign(columns * rows, -1);
  out.condition_number.assign(columns * rows, not_a_number);
  out.fraction.assign(columns * rows, 0.0);
  return out;
}

Vec3 sides_of(const WorkspaceMap& map, std::size_t cell) {
  return std::ldexp(1.0, -map.cells.level[cell]) / map.resolution * (map.high - map.low);
}

/// The first pixels whose centres are not below a place, in pixels; rounded, so that neighbouring cells agree.
Eigen::Array<std::size_t, 2, 1> first_pixels(const Plane& at, int pixels) {
  const Plane number = ((at - 0.5) * 1e6).rint() / 1e6;
  return number.ceil().max(0.0).min(static_cast<double>(pixels)).cast<std::size_t>();
}

/// The boundary cells about a section, and the faces of the box.
class Boundary {
 public:
  Boundary(const WorkspaceMap& map, const Vec3& step, int fixed, double at)
      : low_(Drawn(fixed).of(map.low)), high_(Drawn(fixed).of(map.high)), step_(Drawn(fixed).of(step)) {
    for (std::size_t n = 0; n < map.cells.size(); ++n) {
      const Vec3 centre = map.cells.centre[n], half = 0.5 * sides_of(map, n);
      if (map.cells.state[n] == CellState::boundary && std::abs(centre[fixed] - at) <= half[fixed] + step[fixed])
        cells_.push_back({Drawn(fixed).of(centre), Drawn(fixed).of(half), map.cells.limit[n]});
    }
  }

  /// The limit of the nearest cell, or "box" at a face without one.
  std::int16_t limit_at(const Plane& x) const {
    double least = infinity;
    std::int16_t limit = -1;
    for (const Cut& cell : cells_) {
      const double square = (((cell.centre - x).abs() - cell.half).max(0.0) / step_).square().sum();
      if (!(square < least)) continue;
      least = square;
      limit = cell.limit;
    }
    const bool face = ((x - low_).abs().min((x - high_).abs()) <= step_).any();
    return face && least > 1.0 ? static_cast<std::int16_t>(limit::box()) : limit;
  }

 private:
  struct Cut {
    Plane centre, half;
    std::int16_t limit;
  };
  Plane low_, high_, step_;
  std::vector<Cut> cells_;
};

}  // namespace

WorkspaceSection section_of(const WorkspaceMap& map, int fixed, double at, int pixels, const std::stop_token& stop) {
  if (map.resolution < 1) throw InvalidArgument("map", "no cells", "a map of an octree or a grid");
  if (pixels < 1) throw InvalidArgument("pixels", std::to_string(pixels), "at least 1");
  const Drawn drawn(fixed);
  const Plane low = drawn.of(map.low), pixel = drawn.of(map.high - map.low) / pixels;
  const auto side = static_cast<std::size_t>(pixels);
  WorkspaceSection out = empty_section(low + 0.5 * pixel, pixel, side, side);
  for (std::size_t n = 0; n < map.cells.size(); ++n) {
    stop_at_times(static_cast<long>(n), stop);
    // Half open, so that a plane between two layers belongs to one of them.
    const Vec3 centre = map.cells.centre[n], half = 0.5 * sides_of(map, n);
    const double away = 0.5 * (at - centre[fixed]) / half[fixed];
    if (!(away >= -0.5 && (away < 0.5 || at >= map.high[fixed]) && away <= 0.5 + 1e-9)) continue;
    const auto first = first_pixels((drawn.of(centre - half) - low) / pixel, pixels);
    const auto last = first_pixels((drawn.of(centre + half) - low) / pixel, pixels);
    const bool held = map.cells.fraction[n] > 0.0;
    for (std::size_t row = first[1]; row < last[1]; ++row)
      for (std::size_t place = row * side + first[0]; place < row * side + last[0]; ++place) {
        out.state[place] = held ? map.cells.state[n] : CellState::outside;
        out.limit[place] = map.cells.limit[n];
        out.condition_number[place] = held ? map.cells.condition_number[n] : not_a_number;
        out.fraction[place] = map.cells.fraction[n];
      }
  }
  return out;
}

WorkspaceSection section_of(const WorkspaceMap& map, const WorkspaceField& field, int fixed, double at,
                            const std::stop_token& stop) {
  const Drawn drawn(fixed);
  const Raster& raster = field.fraction;
  const auto f = at_index(fixed), h = at_index(drawn.horizontal), v = at_index(drawn.vertical);
  if (raster.count[f] < 2) throw InvalidArgument("field", "fewer than two points along an axis", "at least two");
  WorkspaceSection out = empty_section(drawn.of(raster.first), drawn.of(raster.step), raster.count[h], raster.count[v]);
  const double last = static_cast<double>(raster.count[f] - 1);
  const double place = (at - raster.first[fixed]) / raster.step[fixed];
  if (!(place >= 0.0 && place <= last)) return out;
  const std::size_t before = std::min(static_cast<std::size_t>(place), raster.count[f] - 2);
  const double share = place - static_cast<double>(before);
  const auto stride = strides(raster.count);
  const auto between = [&](const std::vector<double>& values, std::size_t n) {
    return (1.0 - share) * values[n] + share * values[n + stride[f]];
  };
  const Boundary boundary(map, raster.step, fixed, at);
  for (std::size_t n = 0; n < out.fraction.size(); ++n) {
    const std::size_t row = n / raster.count[h], column = n % raster.count[h];
    if (column == 0 && stop.stop_requested()) throw Stopped{};
    const std::size_t from = before * stride[f] + row * stride[v] + column * stride[h];
    out.fraction[n] = between(raster.values, from);
    if (!(out.fraction[n] > 0.0)) continue;
    out.condition_number[n] = between(field.condition_number.values, from);
    out.state[n] = out.fraction[n] < 1.0 ? CellState::boundary : CellState::inside;
    if (out.fraction[n] < 1.0) out.limit[n] = boundary.limit_at({out.horizontal[column], out.vertical[row]});
  }
  return out;
}

}  // namespace ninedof
