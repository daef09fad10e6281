/// Declared in ninedof/workspace/field.hpp.

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "math/stop_at_times.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/workspace/field.hpp"
#include "workspace/criteria/limits.hpp"
#include "workspace/drawing/raster.hpp"

namespace ninedof {
namespace {

/// The two coordinates that are drawn.
struct Drawn {
  int horizontal, vertical;
  explicit Drawn(int fixed) : horizontal(fixed == 0 ? 1 : 0), vertical(fixed == 2 ? 1 : 2) {
    if (fixed < 0 || fixed > 2) throw InvalidArgument("fixed", std::to_string(fixed), "0, 1 or 2");
  }
};

Vec3 sides_of(const WorkspaceMap& map, std::size_t cell) {
  return std::ldexp(1.0, -map.cells.level[cell]) / map.resolution * (map.high - map.low);
}

/// `count` points from `first` on.
std::vector<double> axis_of(double first, double step, std::size_t count) {
  std::vector<double> out;
  for (std::size_t n = 0; n < count; ++n) out.push_back(first + step * static_cast<double>(n));
  return out;
}

WorkspaceSection empty_section(std::vector<double> horizontal, std::vector<double> vertical) {
  const std::size_t count = horizontal.size() * vertical.size();
  return {std::move(horizontal),
          std::move(vertical),
          std::vector(count, CellState::outside),
          std::vector<std::int16_t>(count, -1),
          std::vector(count, not_a_number),
          std::vector(count, 0.0)};
}

/// The first pixel whose centre is not below `at`, in pixels; rounded, so that neighbouring cells agree.
std::size_t first_pixel(double at, int pixels) {
  const double number = std::ceil(std::rint((at - 0.5) * 1e6) / 1e6);
  return static_cast<std::size_t>(std::clamp(number, 0.0, static_cast<double>(pixels)));
}

/// Points of a section to find the nearest boundary cells of, in the two coordinates drawn.
class BoundaryCells {
 public:
  BoundaryCells(const WorkspaceMap& map, const Vec3& step, int fixed, double at)
      : drawn_(fixed), map_(map), step_(step) {
    for (std::size_t n = 0; n < map.cells.size(); ++n) {
      if (map.cells.state[n] != CellState::boundary) continue;
      const Vec3 sides = sides_of(map, n);
      if (std::abs(map.cells.centre[n][fixed] - at) > 0.5 * sides[fixed] + step[fixed]) continue;
      near_.push_back({map.cells.centre[n], 0.5 * sides, map.cells.limit[n]});
    }
  }

  std::int16_t limit_at(double horizontal, double vertical) const {
    double least = infinity;
    std::int16_t limit = -1;
    for (const Near& cell : near_) {
      const double away = square(cell, horizontal, drawn_.horizontal) + square(cell, vertical, drawn_.vertical);
      if (!(away < least)) continue;
      least = away;
      limit = cell.limit;
    }
    const bool face = on_face(horizontal, drawn_.horizontal) || on_face(vertical, drawn_.vertical);
    return face && least > 1.0 ? static_cast<std::int16_t>(limit::box) : limit;
  }

 private:
  struct Near {
    Vec3 centre, half;
    std::int16_t limit;
  };

  double square(const Near& cell, double at, int axis) const {
    const double away = std::max(std::abs(cell.centre[axis] - at) - cell.half[axis], 0.0) / step_[axis];
    return away * away;
  }
  bool on_face(double at, int axis) const {
    return std::min(std::abs(at - map_.low[axis]), std::abs(at - map_.high[axis])) <= step_[axis];
  }

  Drawn drawn_;
  const WorkspaceMap& map_;
  Vec3 step_;
  std::vector<Near> near_;
};

}  // namespace

WorkspaceSection section_of(const WorkspaceMap& map, int fixed, double at, int pixels, const std::stop_token& stop) {
  if (map.resolution < 1) throw InvalidArgument("map", "no cells", "a map of an octree or a grid");
  if (pixels < 1) throw InvalidArgument("pixels", std::to_string(pixels), "at least 1");
  const Drawn drawn(fixed);
  const Vec3 pixel = (map.high - map.low) / pixels, middle = map.low + 0.5 * pixel;
  const auto count = static_cast<std::size_t>(pixels);
  WorkspaceSection out = empty_section(axis_of(middle[drawn.horizontal], pixel[drawn.horizontal], count),
                                       axis_of(middle[drawn.vertical], pixel[drawn.vertical], count));
  for (std::size_t n = 0; n < map.cells.size(); ++n) {
    stop_at_times(static_cast<long>(n), stop);
    // Half open, so that a plane between two layers belongs to one of them.
    const Vec3 sides = sides_of(map, n), centre = map.cells.centre[n];
    const double away = (at - centre[fixed]) / sides[fixed];
    if (!(away >= -0.5 && (away < 0.5 || at >= map.high[fixed]) && away <= 0.5 + 1e-9)) continue;
    const Vec3 low = (centre - 0.5 * sides - map.low).cwiseQuotient(pixel);
    const Vec3 high = (centre + 0.5 * sides - map.low).cwiseQuotient(pixel);
    const bool held = map.cells.fraction[n] > 0.0;
    for (std::size_t v = first_pixel(low[drawn.vertical], pixels); v < first_pixel(high[drawn.vertical], pixels); ++v)
      for (std::size_t h = first_pixel(low[drawn.horizontal], pixels); h < first_pixel(high[drawn.horizontal], pixels);
           ++h) {
        const std::size_t place = v * count + h;
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
  const auto h = at_index(drawn.horizontal), v = at_index(drawn.vertical), f = at_index(fixed);
  if (raster.count[f] < 2) throw InvalidArgument("field", "fewer than two points along an axis", "at least two");
  WorkspaceSection out =
      empty_section(axis_of(raster.first[drawn.horizontal], raster.step[drawn.horizontal], raster.count[h]),
                    axis_of(raster.first[drawn.vertical], raster.step[drawn.vertical], raster.count[v]));
  const double last = static_cast<double>(raster.count[f] - 1);
  const double place = (at - raster.first[fixed]) / raster.step[fixed];
  const bool beyond = place < 0.0 || place > last;
  const auto before = std::min(static_cast<std::size_t>(std::clamp(place, 0.0, last)), raster.count[f] - 2);
  const double share = std::clamp(place, 0.0, last) - static_cast<double>(before);
  const auto stride = strides(raster.count);
  const auto between = [&](const std::vector<double>& values, std::size_t n) {
    return (1.0 - share) * values[n] + share * values[n + stride[f]];
  };
  const BoundaryCells boundary(map, raster.step, fixed, at);
  std::size_t n = 0;
  for (std::size_t row = 0; row < out.vertical.size(); ++row) {
    if (stop.stop_requested()) throw Stopped{};
    for (std::size_t column = 0; column < out.horizontal.size(); ++column, ++n) {
      const std::size_t from = before * stride[f] + row * stride[v] + column * stride[h];
      const double fraction = beyond ? 0.0 : between(raster.values, from);
      out.fraction[n] = fraction;
      if (!(fraction > 0.0)) continue;
      out.condition_number[n] = between(field.condition_number.values, from);
      out.state[n] = fraction < 1.0 ? CellState::boundary : CellState::inside;
      if (fraction < 1.0) out.limit[n] = boundary.limit_at(out.horizontal[column], out.vertical[row]);
    }
  }
  return out;
}

}  // namespace ninedof
