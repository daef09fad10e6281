#pragma once
/// A question about a workspace as Python hands it over, for every way to answer it.

#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ninedof/workspace/workspace.hpp"
#include "support/arrays.hpp"

namespace ninedof::python {

template <class T>
T word(const std::string& name, const std::string& given, const std::vector<std::pair<std::string, T>>& known) {
  std::string all;
  for (const auto& [text, value] : known) {
    if (text == given) return value;
    all += (all.empty() ? "\"" : ", \"") + text + "\"";
  }
  throw InvalidArgument(name, "\"" + given + "\"", "one of " + all);
}

inline Vec3 vec3_of(const Array& a) {
  return Eigen::Map<const Vec3>(a.data());
}

inline Mat3 mat3_of(const double* from) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(from);
}

/// What Python has checked and named; see python/ninedof/workspace.
inline WorkspaceDomain domain_from(const py::dict& d) {
  WorkspaceDomain out;
  out.archetype = word<Archetype>("archetype", d["archetype"].cast<std::string>(),
                                  {{"constant_orientation", Archetype::constant_orientation},
                                   {"orientation", Archetype::orientation},
                                   {"reachable", Archetype::reachable},
                                   {"inclusive", Archetype::inclusive}});
  out.low = vec3_of(d["low"].cast<Array>());
  out.high = vec3_of(d["high"].cast<Array>());
  out.position = vec3_of(d["position"].cast<Array>());
  const auto rotations = d["rotations"].cast<Array>();
  out.rotations.clear();
  for (py::ssize_t k = 0; k < rotations.size() / 9; ++k) out.rotations.push_back(mat3_of(rotations.data() + 9 * k));
  using Chart = OrientationRegion::Chart;
  out.region.chart = word<Chart>("chart", d["chart"].cast<std::string>(),
                                 {{"rotation_vector", Chart::rotation_vector}, {"tilt_torsion", Chart::tilt_torsion}});
  out.region.angle = d["angle"].cast<double>();
  std::tie(out.region.torsion_low, out.region.torsion_high) = d["torsion"].cast<std::pair<double, double>>();
  return out;
}

inline InternalPointRule rule_from(const std::string& kind, double fraction, const Array& point) {
  using enum InternalPointRule::Kind;
  return {word<InternalPointRule::Kind>(
              "internal_point", kind, {{"fixed", fixed}, {"between", between}, {"platform", platform}, {"best", best}}),
          fraction, vec3_of(point)};
}

/// A criterion: whether it is asked for, a limit, or a limit and an axis. Adds none for None or False.
inline void add_limit(const ConstraintInfo& row, const py::object& given, std::vector<Limit>& out) {
  if (given.is_none() || given.is(py::bool_(false))) return;
  Limit limit{.name = row.name};
  double& side = row.sides == LimitSides::only_low ? limit.low : limit.high;
  if (row.kind == LimitKind::angle) {
    const auto [angle, axis] = given.cast<std::pair<double, Array>>();
    side = angle;
    limit.axis = vec3_of(axis);
  } else if (row.kind != LimitKind::sign) {
    side = given.cast<double>();
  }
  out.push_back(limit);
}

inline WorkspaceCriteria criteria_from(const py::dict& d) {
  WorkspaceCriteria out;
  if (!d["leg_limits"].is_none()) {
    const auto [low, high] = d["leg_limits"].cast<std::pair<Array, Array>>();
    out.legs = LegLimits{Eigen::Map<const Vec9>(low.data()), Eigen::Map<const Vec9>(high.data())};
  }
  out.condition_number = d["condition_number"].cast<std::optional<double>>();
  const std::vector<std::string> rows = limits_of_poses();
  for (const ConstraintInfo& row : criterion_table())
    if (std::ranges::find(rows, row.name) != rows.end()) add_limit(row, d[row.name], out.limits);
  if (d.contains("exempt")) out.exempt = d["exempt"].cast<std::array<bool, 21>>();
  out.characteristic_length = d["characteristic_length"].cast<double>();
  return out;
}

/// None, or position, rotation and O.
inline std::optional<Configuration> home_from(const py::object& home) {
  if (home.is_none()) return {};
  const auto [p, q, o] = home.cast<std::tuple<Array, Array, Array>>();
  return Configuration{vec3_of(p), mat3_of(q.data()), vec3_of(o)};
}

}  // namespace ninedof::python
