#include "ninedof/proof/machine.hpp"

#include <pybind11/stl.h>

#include "ninedof/math/interval.hpp"
#include "ninedof/problem/problem.hpp"
#include "ninedof/proof/bounds.hpp"
#include "support/arrays.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/region.hpp"

namespace ninedof::python {
namespace {

constexpr std::size_t most_kept = 20'000;
constexpr long boxes_by_rule = 2'000'000;  // a rule is fitted until limits are only just kept

/// Where O is in the region: scales of the six coordinates, powers and coefficients of each term.
PointRule rule_from(const py::dict& d) {
  PointRule out;
  const auto scale = d["scale"].cast<std::array<double, 6>>();
  out.scale = Vec6::Map(scale.data());
  out.powers = d["powers"].cast<std::vector<std::array<int, 6>>>();
  for (const auto& c : d["coefficients"].cast<std::vector<std::array<double, 3>>>())
    out.coefficients.push_back(Vec3::Map(c.data()));
  out.validate();
  return out;
}

/// `region` is None or a mapping, with a "rule" where O follows one; the neutral configuration comes first in the
/// stack, then the listed poses.
PosedRobot robot_from(const Geometry& g, const Array& position, const Array& rotation, const Array& internal_point,
                      double characteristic_length, const py::object& region) {
  const ConfigurationStack all(position, rotation, internal_point);
  PosedRobot out{g, all[0], characteristic_length, {}, {}, {}};
  if (!region.is_none()) {
    out.region.push_back(region_from(region.cast<py::dict>()));
    out.region.front().validate();
    if (region.contains("rule")) out.rule.push_back(rule_from(region["rule"].cast<py::dict>()));
  }
  for (long k = 1; k < all.count(); ++k) out.poses.push_back(all[k]);
  return out;
}

ProofSettings settings_from(const py::dict& d) {
  ProofSettings out;
  out.threads = d["threads"].cast<int>();
  out.seconds = d["seconds"].cast<double>();
  out.gap = d["gap"].cast<double>();
  out.condition = d["condition"].cast<double>();
  require_sound_arithmetic();
  return out;
}

/// (shift of p, tilt, yaw, index of a listed pose or -1)
py::tuple tuple_of(const MetAt& at) {
  const auto three = [](const Vec3& v) { return py::make_tuple(v[0], v[1], v[2]); };
  return py::make_tuple(three(at.shift), three(at.tilt), at.yaw, at.pose);
}

}  // namespace

void bind_machine(py::module_& m) {
  m.def("limits_over_poses",
        [](const Geometry& g, const Array& position, const Array& rotation, const Array& internal_point,
           const py::object& region, const Problem& problem, double tolerance, const py::dict& settings) {
          const PosedRobot robot = robot_from(g, position, rotation, internal_point, 1.0, region);
          ProofSettings how = settings_from(settings);
          if (!robot.rule.empty()) how.boxes = boxes_by_rule;
          const LimitsOverPoses found = interruptible(py::none(), [&](const Control& control) {
            return limits_over_poses(robot, problem.limits, exempt_pairs(problem), tolerance, how, control);
          });
          constexpr std::array words{"proved", "violated", "undecided"};
          py::list limits, lengths, met;
          for (const LimitOverPoses& one : found.limits) {
            py::list at;
            for (const MetAt& pose : one.at) at.append(tuple_of(pose));
            const auto ends = [](const Interval& x) { return py::make_tuple(x.lo, x.hi); };
            limits.append(py::make_tuple(one.name, to_string(one.kind), one.side == Side::high ? "max" : "min",
                                         one.limit, ends(one.value), words[static_cast<std::size_t>(one.answer)],
                                         one.part, at, one.at_neutral, one.boxes));
          }
          for (const Interval& length : found.lengths) lengths.append(py::make_tuple(length.lo, length.hi));
          for (const MetAt& pose : found.met) met.append(tuple_of(pose));
          return py::make_tuple(limits, lengths, met);
        });
  m.def("worst_condition", [](const Geometry& g, const Array& position, const Array& rotation,
                              const Array& internal_point, double characteristic_length, const py::object& region,
                              const py::dict& settings, const PoseBoxes& from, const py::object& progress) {
    const PosedRobot robot = robot_from(g, position, rotation, internal_point, characteristic_length, region);
    const ProofSettings how = settings_from(settings);
    const WorstCondition found = interruptible(
        progress, [&](const Control& control) { return worst_condition(robot, how, from, control); },
        [](WorstCondition& worst) { return worst.interrupted = true; });
    // More boxes than a record holds are only counted: as Python objects they would fill the memory.
    const auto count = found.left.size();
    return py::make_tuple(found.extreme.low, found.extreme.high, tuple_of(found.extreme.at), found.extreme.boxes,
                          count <= most_kept ? found.left : PoseBoxes{}, count, found.tried, found.interrupted);
  });
}

}  // namespace ninedof::python
