#include "ninedof/limits/limits.hpp"

#include <pybind11/stl.h>

#include "ninedof/limits/numbers.hpp"
#include "support/arrays.hpp"
#include "support/module.hpp"
#include "support/without_gil.hpp"

namespace ninedof::python {

void bind_limits(py::module_& m) {
  py::dict parts;
  for (const std::string& name : limits_of_poses()) parts[py::str(name)] = py::tuple(py::cast(limit_parts(name)));
  m.attr("limit_parts") = parts;
  m.attr("limits_over_lengths") = py::tuple(py::cast(limits_over_lengths()));
  m.attr("margin_tolerance") = margin_tolerance;
  m.def("limit_numbers", [](const std::string& name, const std::vector<double>& axis, const Geometry& g,
                            const Array& home_p, const Array& home_q, const Array& home_s, const Array& p,
                            const Array& q, const Array& s) {
    const ConfigurationStack home(home_p, home_q, home_s), c(p, q, s);
    const LimitNumbers numbers(name, g, home[0], axis.size() == 3 ? Vec3(axis[0], axis[1], axis[2]) : Vec3(0, 0, 0));
    return for_each_row(c.count(), numbers.items(), 0, py::none(), [&](long k, double* out) { numbers.at(c[k], out); });
  });
  m.def("pairs_sharing_a_joint", [](const Geometry& g) { return pairs_sharing_a_joint(g); });
}

}  // namespace ninedof::python
