#pragma once
/// The cells of a map as Python keeps them: with their sides instead of their levels.

#include <cmath>

#include "ninedof/workspace/workspace.hpp"
#include "support/struct.hpp"

namespace ninedof::python {

/// Ends, cells and resolution of a map of Python: the resolution is that of the largest cells, 0 for the points of a
/// sample. Throws InvalidArgument unless all cells lie in the box: a file may hold anything.
inline WorkspaceMap map_from(const py::object& map) {
  constexpr int deepest = 20;
  WorkspaceMap out;
  out.low = map.attr("low").cast<Vec3>();
  out.high = map.attr("high").cast<Vec3>();
  const py::object cells = map.attr("cells");
  WorkspaceCells& c = out.cells;
  c.centre = points_from("cells", cells.attr("centre"));
  const std::vector<Vec3> sides = points_from("cells", cells.attr("size"));
  const auto count = std::ssize(c.centre);
  c.state = list_from<std::uint8_t, CellState>("cells", cells.attr("state"), count);
  c.limit = list_from<std::int16_t>("cells", cells.attr("limit"), count);
  c.fraction = list_from<double>("cells", cells.attr("fraction"), count);
  c.condition_number = list_from<double>("cells", cells.attr("condition_number"), count);
  c.piece = list_from<std::int32_t>("cells", cells.attr("piece"), count);
  double largest = 0.0;
  bool sound = std::ssize(sides) == count;
  for (const Vec3& side : sides) largest = std::max(largest, side.x());
  if (largest > 0.0)
    out.resolution = static_cast<int>(std::clamp(std::rint((out.high - out.low).x() / largest), 1.0, 1e6));
  for (std::size_t n = 0; sound && n < c.size(); ++n) {
    const double level = largest > 0.0 ? std::rint(std::log2(largest / sides[n].x())) : 0.0;
    sound = level >= 0.0 && level <= deepest && (c.centre[n].array() >= out.low.array()).all() &&
            (c.centre[n].array() <= out.high.array()).all();
    c.level.push_back(sound ? static_cast<std::uint8_t>(level) : std::uint8_t{0});
  }
  if (!sound)
    throw InvalidArgument("cells", "cells that do not fit the box", "cells of an octree or a grid between its ends");
  return out;
}

}  // namespace ninedof::python
