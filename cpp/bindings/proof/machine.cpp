#include "ninedof/proof/machine.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <tuple>

#include "ninedof/math/interval.hpp"
#include "ninedof/problem/problem.hpp"
#include "ninedof/proof/bounds.hpp"
#include "support/arrays.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/region.hpp"

namespace ninedof::python {
namespace {

using Three = std::array<double, 3>;

Vec3 vector(const Three& v) {
  return Vec3::Map(v.data());
}
std::tuple<double, double, double> numbers(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

PointRule rule_from(const std::array<double, 6>& scale, const std::vector<std::array<int, 6>>& powers,
                    const std::vector<Three>& coefficients) {
  PointRule out{Vec6::Map(scale.data()), powers, {}};
  for (const Three& c : coefficients) out.coefficients.push_back(vector(c));
  out.validate();
  return out;
}

/// The neutral configuration comes first in the stack, then the listed poses.
PosedRobot robot_from(const Geometry& g, const Array& position, const Array& rotation, const Array& internal_point,
                      double characteristic_length, const std::optional<py::dict>& region,
                      const std::optional<PointRule>& rule) {
  const ConfigurationStack all(position, rotation, internal_point);
  PosedRobot out{g, all[0], characteristic_length, {}, {}, {}};
  if (region) {
    out.region.push_back(region_from(*region));
    out.region.front().validate();
  }
  if (rule) out.rule.push_back(*rule);
  for (long k = 1; k < all.count(); ++k) out.poses.push_back(all[k]);
  return out;
}

void bind_structs(py::module_& m) {
  py::class_<PointRule>(m, "PointRule")
      .def(py::init(&rule_from))
      .def_property_readonly("scale",
                             [](const PointRule& rule) {
                               std::array<double, 6> out;
                               Vec6::Map(out.data()) = rule.scale;
                               return out;
                             })
      .def_readonly("powers", &PointRule::powers)
      .def_property_readonly("coefficients", [](const PointRule& rule) {
        py::list out;
        for (const Vec3& c : rule.coefficients) out.append(numbers(c));
        return out;
      });
  py::class_<PosedRobot>(m, "PosedRobot").def(py::init(&robot_from));
  py::class_<MetAt>(m, "MetAt")
      .def(py::init([](const Three& shift, const Three& tilt, double yaw, int pose) {
        return MetAt{vector(shift), vector(tilt), yaw, pose};
      }))
      .def_property_readonly("shift", [](const MetAt& at) { return numbers(at.shift); })
      .def_property_readonly("tilt", [](const MetAt& at) { return numbers(at.tilt); })
      .def_readonly("yaw", &MetAt::yaw)
      .def_readonly("pose", &MetAt::pose);
}

}  // namespace

void bind_machine(py::module_& m) {
  bind_structs(m);
  m.def("limits_over_poses",
        [](const PosedRobot& machine, const Problem& problem, double tolerance, int threads, double seconds) {
          require_sound_arithmetic();
          const LimitsOverPoses found = interruptible(py::none(), [&](const Control& control) {
            return limits_over_poses(machine, problem.limits, exempt_pairs(problem), tolerance,
                                     {.threads = threads, .seconds = seconds}, control);
          });
          constexpr std::array words{"proved", "violated", "undecided"};
          py::list limits, lengths;
          for (const LimitOverPoses& one : found.limits) {
            const auto ends = [](const Interval& x) { return py::make_tuple(x.lo, x.hi); };
            limits.append(py::make_tuple(one.name, to_string(one.kind), one.side == Side::high ? "max" : "min",
                                         one.limit, ends(one.value), words[static_cast<std::size_t>(one.answer)],
                                         one.part, one.at, one.at_neutral, one.boxes));
          }
          for (const Interval& length : found.lengths) lengths.append(py::make_tuple(length.lo, length.hi));
          return py::make_tuple(limits, lengths);
        });
}

}  // namespace ninedof::python
