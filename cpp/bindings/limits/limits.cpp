#include "ninedof/limits/limits.hpp"

#include "ninedof/limits/numbers.hpp"
#include "support/loads.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"
#include "support/without_gil.hpp"

namespace ninedof::python {

void bind_limits(py::module_& m) {
  request<Duty>(m, "Duty", "What legs push and how the platform moves.")
      .def_property(
          "loads", [](const Duty& d) { return d.loads.size(); },
          [](Duty& d, const std::vector<Vec6>& rows) { d.loads = loads_from(rows); },
          "Rows (moment about p, force), base axes; their number is read.")
      .def_readwrite("masses", &Duty::masses, "Their weights are added to each load.")
      .def_readwrite("gravity", &Duty::gravity, "Force per mass, base axes.")
      .def_readwrite("motion", &Duty::motion, "The speeds of the platform, and how O moves.");
  auto limit = request<Limit>(m, "Limit", "low <= a named quantity <= high, in lengths, radians or ratios.");
  limit.def_readwrite("name", &Limit::name, "As in the table of limits.")
      .def_readwrite("low", &Limit::low, "0 or minus infinity: an open side.")
      .def_readwrite("high", &Limit::high, "Infinity: an open side.")
      .def_readwrite("axis", &Limit::axis, "Of a cone, in the frame of its body; zero: each leg's neutral direction.")
      .def_readwrite("steps", &Limit::steps, "Parts of the way to each pose that singularity_free tests.")
      .def_property_readonly("label", &Limit::label, "The name, followed by \" at neutral\" for that pose alone.");
  limit.def_property(
      "duty", [](const Limit& l) { return l.duty ? std::optional(*l.duty) : std::nullopt; },
      [](Limit& l, const std::optional<Duty>& duty) { l.duty = duty ? std::make_shared<const Duty>(*duty) : nullptr; },
      "Of forces, rates and powers, or None.");
  word_attribute(limit, "of", &Limit::of, std::array{"length", "zp", "radius"}, "What a length is a fraction of.");
  word_attribute(limit, "at", &Limit::at, std::array{"poses", "neutral"}, "Where it holds.");

  const auto with_parts = [](const std::vector<std::string>& names) {
    py::dict out;
    for (const std::string& name : names) out[py::str(name)] = py::tuple(py::cast(limit_parts(name)));
    return out;
  };
  m.attr("limit_parts") = with_parts(limits_of_poses());
  m.attr("limits_over_lengths") = with_parts(limits_over_lengths());
  m.attr("margin_tolerance") = margin_tolerance;
  m.def("margin", [](const std::string& kind, const std::string& side, const Array& bound, const Array& value) {
    const auto of = [k = limit_kind_from(kind), s = side == "min" ? Side::low : Side::high](double l, double v) {
      return margin(k, s, l, v);
    };
    return py::vectorize(of)(bound, value);
  });
  m.def("limit_numbers", [](const Limit& one, const Geometry& g, const Configuration& home, const ConfigurationStack& c,
                            double characteristic_length) {
    const LimitNumbers numbers(one.name, g, home, characteristic_length, one.options());
    return for_each_row(c.count(), numbers.items(), 0, py::none(), [&](long k, double* out) { numbers.at(c[k], out); });
  });
  m.def("spread_numbers", [](const std::string& name, const Array& longest, const Array& shortest) {
    const SpreadRow& row = spread_row(name);
    const std::vector<Vec9> most = lengths_from(longest), least = lengths_from(shortest);
    if (most.size() != least.size()) throw InvalidArgument("longest, shortest", "stacks of two lengths", "one length");
    return for_each_row(std::ssize(most), row.items(), 0, py::none(), [&](long k, double* out) {
      for (int leg = 0; leg < row.items(); ++leg) out[leg] = row.number(most[at_index(k)], least[at_index(k)], leg);
    });
  });
  m.def("pairs_sharing_a_joint", [](const Geometry& g) { return pairs_sharing_a_joint(g); });
}

}  // namespace ninedof::python
