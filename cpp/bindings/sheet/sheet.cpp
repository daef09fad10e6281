#include <pybind11/stl.h>

#include "ninedof/sheet/sheet_region.hpp"
#include "support/arrays.hpp"
#include "support/module.hpp"
#include "support/placing.hpp"
#include "support/region.hpp"
#include "support/without_gil.hpp"

namespace ninedof::python {
namespace {

using Three = std::array<double, 3>;
using Six = std::array<double, 6>;
using Nine = std::array<double, 9>;

Vec3 three(const Three& v) {
  return Vec3::Map(v.data());
}

PlatformMotion motion_from(const std::string& internal, double linear_speed, double angular_speed,
                           const std::optional<std::pair<Six, Six>>& given) {
  PlatformMotion out{internal_motion_from(internal), linear_speed, angular_speed, {}};
  if (given) out.given = TwistMotion{Vec6::Map(given->first.data()), Vec6::Map(given->second.data())};
  return out;
}

SheetQuestion question(const Geometry& g, const Array& p, const Array& q, const Array& s,
                       const std::vector<std::pair<std::string, Three>>& limits, const std::array<bool, 21>& exempt,
                       const PlatformMotion& motion, const std::vector<Six>& loads,
                       const std::optional<std::tuple<double, Three, Three>>& weight,
                       const std::optional<std::pair<Nine, std::array<double, 12>>>& errors,
                       const std::optional<Nine>& leg_stiffness, const std::optional<double>& characteristic_length) {
  SheetQuestion out{g, ConfigurationStack(p, q, s)[0], {}, exempt, motion, {}, {}, {}, {}, characteristic_length};
  for (const auto& [name, axis] : limits) out.limits.emplace_back(name, three(axis));
  for (const Six& load : loads) out.loads.push_back({Vec3::Map(load.data()), Vec3::Map(load.data() + 3), Vec3::Zero()});
  if (weight) out.weight = Weight{std::get<0>(*weight), three(std::get<1>(*weight)), three(std::get<2>(*weight))};
  if (errors) out.errors = Tolerances{Vec9::Map(errors->first.data()), errors->second};
  if (leg_stiffness) out.leg_stiffness = Vec9::Map(leg_stiffness->data());
  return out;
}

/// (name, numbers at every pose, shape (n, k)) for each group.
py::list numbers_of(const SheetQuestion& question, const Array& p, const Array& q, const Array& s) {
  const ConfigurationStack c(p, q, s);
  const SheetNumbers numbers(question);
  py::list out;
  for (std::size_t k = 0; k < numbers.groups().size(); ++k) {
    const SheetGroup& group = numbers.groups()[k];
    const Array values =
        for_each_row(c.count(), group.size, 0, py::none(), [&](long i, double* to) { numbers.evaluate(k, c[i], to); });
    out.append(py::make_tuple(group.name, values));
  }
  return out;
}

/// What gives every thread its own way to place O.
std::function<PlacedAt()> placing_from(const Problem& problem, const Region& region, const std::vector<double>& x,
                                       const PlacementGoal& goal, const std::vector<Vec3>& known,
                                       const Configuration& neutral) {
  const Eigen::VectorXd variables = Eigen::VectorXd::Map(x.data(), static_cast<Eigen::Index>(x.size()));
  return [=] {
    return [place = placer(problem, region, variables, goal, known), region, neutral](const Vec6& at) {
      Configuration out = region.configuration(at, neutral);
      out.internal_point = neutral.internal_point + neutral.position[2] * place(at).placed.shift;
      return out;
    };
  };
}

using PlacingEntry = std::tuple<Problem, std::vector<double>, double, std::vector<RangeEntry>, std::vector<Three>>;

/// Coordinates of the worst poses, shape (n, 6), how many were looked at, and the mean condition number with its error.
py::tuple over_region(const SheetQuestion& question, const py::dict& region, long samples,
                      const std::optional<PlacingEntry>& placed) {
  const Region r = region_from(region);
  std::function<PlacedAt()> placing;
  if (placed) {
    const auto& [problem, x, log_index, ranges, known] = *placed;
    const PlacementGoal goal{log_index, ranges_from(problem, ranges)};
    placing = placing_from(problem, r, x, goal, shifts_from(known), question.neutral);
  }
  const SheetRegion found = interruptible(py::none(), [&](const Control& control) {
    return sheet_over_region(question, r, {.samples = samples}, placing, control);
  });
  Array worst({static_cast<py::ssize_t>(found.worst.size()), py::ssize_t{6}});
  for (std::size_t k = 0; k < found.worst.size(); ++k)
    Vec6::Map(worst.mutable_data(static_cast<py::ssize_t>(k), 0)) = found.worst[k];
  return py::make_tuple(worst, found.poses, found.mean, found.mean_error);
}

py::tuple lengths_over(const Geometry& g, const Array& p, const Array& q, const Array& s, const py::dict& region,
                       long samples) {
  const Region r = region_from(region);
  const Configuration neutral = ConfigurationStack(p, q, s)[0];
  const std::array<Vec9, 2> found = interruptible(py::none(), [&](const Control& control) {
    return leg_lengths_over(g, neutral, r, {.samples = samples}, control);
  });
  return py::make_tuple(array_from(found[0]), array_from(found[1]));
}

}  // namespace

void bind_sheet(py::module_& m) {
  py::class_<PlatformMotion>(m, "PlatformMotion")
      .def(py::init(&motion_from), py::arg("internal"), py::arg("linear_speed"), py::arg("angular_speed"),
           py::arg("given"));
  py::class_<SheetQuestion>(m, "SheetQuestion")
      .def(py::init(&question), py::arg("geometry"), py::arg("position"), py::arg("rotation"),
           py::arg("internal_point"), py::arg("limits"), py::arg("exempt"), py::arg("motion"), py::arg("loads"),
           py::arg("weight"), py::arg("errors"), py::arg("leg_stiffness"), py::arg("characteristic_length"));
  m.def("sheet_numbers", &numbers_of);
  m.def("sheet_over_region", &over_region);
  m.def("leg_lengths_over", &lengths_over);
}

}  // namespace ninedof::python
