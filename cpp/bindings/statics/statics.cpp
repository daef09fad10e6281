#include "ninedof/statics/statics.hpp"

#include "support/configurations.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

/// The data of an array with nine numbers for each configuration.
const double* nine_for_each(const std::string& name, const Array& a, long count) {
  if (a.size() != 9 * count)
    throw InvalidArgument(name, std::to_string(a.size()) + " numbers", std::to_string(9 * count));
  return a.data();
}

}  // namespace

void bind_statics(py::module_& m) {
  m.def("leg_forces", [](const Geometry& g, const ConfigurationStack& c, const Array& load, int threads) {
    const double* loads = nine_for_each("load", load, c.count());
    return for_each_row(c.count(), 18, threads, py::none(), [&](long i, double* out) {
      const Eigen::Map<const Vec9> w(loads + 9 * i);
      const LegForces f = leg_forces(g, c[i], {w.head<3>(), w.segment<3>(3), w.tail<3>()});
      Eigen::Map<Eigen::Matrix<double, 18, 1>>{out} << f.forces, f.unbalanced.moment, f.unbalanced.force,
          f.unbalanced.force_at_o;
    });
  });
  m.def("self_stress", [](const Geometry& g, const ConfigurationStack& c) { return array_from(self_stress(g, c[0])); });
  m.def("stiffness", [](const Geometry& g, const ConfigurationStack& c, const Array& legs, int threads) {
    const double* k = nine_for_each("leg_stiffness", legs, c.count());
    return for_each_row(c.count(), 36, threads, py::none(), [&](long i, double* out) {
      Eigen::Map<Mat6>{out} = stiffness(g, c[i], Eigen::Map<const Vec9>(k + 9 * i));  // symmetric: any order
    });
  });
  m.def("stiffness_with_o", [](const Geometry& g, const ConfigurationStack& c, const Array& legs, int threads) {
    const double* k = nine_for_each("leg_stiffness", legs, c.count());
    return for_each_row(c.count(), 81, threads, py::none(), [&](long i, double* out) {
      Eigen::Map<Mat9>{out} = stiffness_with_o(g, c[i], Eigen::Map<const Vec9>(k + 9 * i));
    });
  });
}

}  // namespace ninedof::python
