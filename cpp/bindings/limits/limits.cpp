#include "ninedof/limits/limits.hpp"

#include "ninedof/limits/numbers.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"
#include "support/without_gil.hpp"

namespace ninedof::python {

void bind_limits(py::module_& m) {
  auto limit = request<Limit>(m, "Limit", "low <= a named quantity <= high, in lengths, radians or ratios.");
  limit.def_readwrite("name", &Limit::name, "As in the table of limits.")
      .def_readwrite("low", &Limit::low, "0 or minus infinity: an open side.")
      .def_readwrite("high", &Limit::high, "Infinity: an open side.")
      .def_readwrite("axis", &Limit::axis, "Of a cone, in the frame of its body; zero: each leg's neutral direction.")
      .def_readwrite("steps", &Limit::steps, "Parts of the way to each pose that singularity_free tests.")
      .def_property_readonly("label", &Limit::label, "The name, followed by \" at neutral\" for that pose alone.");
  word_attribute(limit, "of", &Limit::of, std::array{"length", "zp", "radius"}, "What a length is a fraction of.");
  word_attribute(limit, "at", &Limit::at, std::array{"poses", "neutral"}, "Where it holds.");

  py::dict parts;
  for (const std::string& name : limits_of_poses()) parts[py::str(name)] = py::tuple(py::cast(limit_parts(name)));
  m.attr("limit_parts") = parts;
  m.attr("limits_over_lengths") = py::tuple(py::cast(limits_over_lengths()));
  m.attr("margin_tolerance") = margin_tolerance;
  m.def("limit_numbers", [](const std::string& name, const Vec3& axis, const Geometry& g, const Configuration& home,
                            const ConfigurationStack& c, double characteristic_length) {
    const LimitNumbers numbers(name, g, home, axis, {}, characteristic_length);
    return for_each_row(c.count(), numbers.items(), 0, py::none(), [&](long k, double* out) { numbers.at(c[k], out); });
  });
  m.def("pairs_sharing_a_joint", [](const Geometry& g) { return pairs_sharing_a_joint(g); });
}

}  // namespace ninedof::python
