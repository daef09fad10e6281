#pragma once
/// A region of poses from the mapping that Python makes of it.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <string>
#include <vector>

#include "ninedof/domains/region.hpp"

namespace ninedof::python {

namespace py = pybind11;

inline Region region_from(const py::dict& d) {
  Region out;
  const auto shape = d["shape"].cast<std::string>();
  if (shape == "ball") out.shape = Region::Shape::ball;
  else if (shape == "cylinder") out.shape = Region::Shape::cylinder;
  else if (shape == "path") out.shape = Region::Shape::path;
  using Three = std::array<double, 3>;
  const auto three = [](const Three& v) { return Vec3(v[0], v[1], v[2]); };
  out.size = three(d["size"].cast<Three>());
  for (const Three& corner : d["corners"].cast<std::vector<Three>>()) out.corners.push_back(three(corner));
  out.tilt = d["tilt"].cast<double>();
  out.yaw = d["yaw"].cast<double>();
  out.shifted = d["shifted"].cast<bool>();
  out.placed = d["placed"].cast<bool>();
  out.in_zp = d["in_zp"].cast<bool>();
  return out;
}

}  // namespace ninedof::python
