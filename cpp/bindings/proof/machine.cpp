#include "ninedof/proof/machine.hpp"

#include <optional>

#include "ninedof/math/interval.hpp"
#include "ninedof/problem/problem.hpp"
#include "ninedof/proof/bounds.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

std::tuple<double, double, double> numbers(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

/// The neutral configuration comes first in the stack, then the listed poses.
PosedRobot robot_from(const Geometry& g, const ConfigurationStack& all, double characteristic_length,
                      const std::optional<Region>& region, const std::optional<PointRule>& rule,
                      const std::optional<Tolerances>& tolerances) {
  PosedRobot out{g, all[0], characteristic_length, {}, {}, {}};
  if (tolerances) out.tolerances = *tolerances;
  if (region) {
    region->validate();
    out.region.push_back(*region);
  }
  if (rule) {
    rule->validate();
    out.rule.push_back(*rule);
  }
  for (long k = 1; k < all.count(); ++k) out.poses.push_back(all[k]);
  return out;
}

void bind_structs(py::module_& m) {
  request<PointRule>(m, "PointRule", "Where O is in a region: a polynomial in the coordinates of a pose.")
      .def_readwrite("scale", &PointRule::scale, "Of the six coordinates of a pose, shape (6,): lengths, then radians.")
      .def_readwrite("powers", &PointRule::powers, "Of each term, six.")
      .def_property("coefficients", copy_of(&PointRule::coefficients), setter_of(&PointRule::coefficients), "Copied.");
  py::class_<PosedRobot>(m, "PosedRobot", "A robot and all poses at which it is looked at.")
      .def(py::init(&robot_from), py::arg(), py::arg(), py::arg(), py::arg(), py::arg(), py::arg() = py::none());
  request<MetAt>(m, "MetAt", "Where a number was met.")
      .def_property(
          "shift", [](const MetAt& at) { return numbers(at.shift); }, [](MetAt& at, const Vec3& v) { at.shift = v; },
          "Of p from its neutral position.")
      .def_property(
          "tilt", [](const MetAt& at) { return numbers(at.tilt); }, [](MetAt& at, const Vec3& v) { at.tilt = v; },
          "Rotation vector about a horizontal axis.")
      .def_readwrite("yaw", &MetAt::yaw, "Radians.")
      .def_readwrite("pose", &MetAt::pose, "Index of a listed pose; -1: a pose of the region.");
  using Proof = LimitOverPoses;
  py::class_<Proof>(m, "LimitOverPoses", "One side of a limit over all poses.")
      .def_readonly("name", &Proof::name, "Its label.")
      .def_property_readonly(
          "kind", [](const Proof& one) { return to_string(one.kind); }, "As in the table of limits.")
      .def_property_readonly(
          "side", [](const Proof& one) { return one.side == Side::high ? "max" : "min"; }, "min or max.")
      .def_readonly("limit", &Proof::limit, "A length, radians or a ratio.")
      .def_property_readonly(
          "value", [](const Proof& one) { return std::pair(one.value.lo, one.value.hi); },
          "Lower and upper bound of the worst value.")
      .def_property_readonly("answer", word_of(&Proof::answer, std::array{"proved", "violated", "undecided"}),
                             "proved, violated or undecided.")
      .def_readonly("which", &Proof::part, "The leg, pair of legs or determinant that is worst.")
      .def_readonly("at", &Proof::at, "Where; of a stroke where the leg is longest and shortest.")
      .def_readonly("at_neutral", &Proof::at_neutral, "Whether it is of the neutral pose alone.")
      .def_readonly("boxes", &Proof::boxes, "Looked at.");
  py::class_<LimitsOverPoses>(m, "LimitsOverPoses", "The limits of a machine over all its poses.")
      .def_readonly("limits", &LimitsOverPoses::limits, "The three determinants first, then the limits in their order.")
      .def_property_readonly(
          "lengths",
          [](const LimitsOverPoses& found) {
            py::list out;
            for (const Interval& length : found.lengths) out.append(py::make_tuple(length.lo, length.hi));
            return py::tuple(out);
          },
          "Least and greatest length of each of the nine legs.");
}

}  // namespace

void bind_machine(py::module_& m) {
  bind_structs(m);
  m.def("limits_over_poses",
        [](const PosedRobot& machine, const Problem& problem, double slack, int threads, double seconds) {
          require_sound_arithmetic();
          PosedRobot robot = machine;
          robot.tool = problem.tool;
          return interruptible(py::none(), [&](const Control& control) {
            return limits_over_poses(robot, problem.limits, exempt_pairs(problem), slack,
                                     {.threads = threads, .seconds = seconds}, control);
          });
        });
  m.def("error_over_poses", [](const PosedRobot& machine, double gap, int threads, double seconds) {
    require_sound_arithmetic();
    return interruptible(py::none(), [&](const Control& control) {
      const ErrorOverPoses e = error_over_poses(machine, {.threads = threads, .seconds = seconds, .gap = gap}, control);
      const auto ends = [](const Interval& x) { return std::pair(x.lo, x.hi); };
      return std::tuple(ends(e.position), ends(e.rotation), ends(e.internal_point));
    });
  });
}

}  // namespace ninedof::python
