#include <pybind11/stl.h>

#include "arrays.hpp"
#include "module.hpp"
#include "ninedof/constraints.hpp"
#include "ninedof/design.hpp"
#include "ninedof/optimize.hpp"

namespace ninedof::python {
namespace {

std::vector<double> full(const Problem& problem, const std::vector<double>& x) {
  if (x.size() != problem.variables.size())
    throw InvalidArgument("variables", std::to_string(x.size()) + " values", std::to_string(problem.variables.size()));
  return x;
}

/// log kappa with its gradient, and every margin with its own, at one design.
py::dict evaluate(const Problem& problem, const std::vector<double>& x) {
  DesignPoint point;
  design_family(problem.family).evaluate(full(problem, x), problem.characteristic_length, point);
  py::list all;
  for (const Margin& m : margins(problem.limits))
    all.append(py::make_tuple(m.name, m.value(point), array_from(m.gradient(point))));
  py::dict out;
  out["log_condition_number"] = point.log_condition_number();
  out["gradient"] = array_from(point.log_condition_number_gradient());
  out["quantities"] = array_from(point.value);
  out["quantity_gradients"] = array_from(point.gradient);
  out["margins"] = all;
  return out;
}

}  // namespace

void bind_design(py::module_& m) {
  m.def("design_family_names", &design_family_names);
  m.def("constraint_names", &constraint_names);
  m.def("family_variables", [](const std::string& family) {
    py::list out;
    for (const VariableInfo& v : design_family(family).variables())
      out.append(py::make_tuple(v.name, v.is_angle, v.low, v.high));
    return out;
  });

  py::class_<Problem>(m, "Problem", "A design problem as the core takes it; made by `Study`.")
      .def(py::init([](std::string family, const std::vector<std::pair<double, double>>& bounds,
                       const std::vector<std::tuple<std::string, double, double>>& limits,
                       double characteristic_length) {
             Problem p{std::move(family), {}, {}, characteristic_length};
             for (const auto& [low, high] : bounds) p.variables.push_back({low, high});
             for (const auto& [name, low, high] : limits) p.limits.push_back({name, low, high});
             p.validate();
             return p;
           }),
           py::arg("family"), py::arg("bounds"), py::arg("limits"), py::arg("characteristic_length"))
      .def("geometry",
           [](const Problem& p, const std::vector<double>& x) { return design_family(p.family).geometry(full(p, x)); })
      .def("configuration",
           [](const Problem& p, const std::vector<double>& x) {
             const Configuration c = design_family(p.family).configuration(full(p, x));
             return py::make_tuple(array_from(c.position), array_from(c.rotation), array_from(c.internal_point));
           })
      .def("evaluate", &evaluate)
      .def("starts", [](const Problem& p, int count, std::uint64_t seed) {
        return array_from(starts(p, {.starts = count, .seed = seed}).transpose());
      });
}

}  // namespace ninedof::python
