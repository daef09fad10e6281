#include <algorithm>
#include <functional>
#include <limits>

#include "arrays.hpp"
#include "lengths.hpp"
#include "module.hpp"
#include "ninedof/characteristic_length.hpp"
#include "ninedof/conditioning.hpp"
#include "ninedof/symmetric.hpp"

namespace ninedof::python {
namespace {

/// Binds one index of a configuration, a number, over a stack.
template <class Index>
void bind_index(py::module_& m, const char* name, Index index) {
  m.def(name, [index](const Geometry& g, const Array& p, const Array& q, const Array& s, const Array& length,
                      int threads, const py::object& out) {
    const ConfigurationStack c(p, q, s);
    const Lengths lc(length, c.count());
    return for_each_row(c.count(), 1, threads, out, [&](long i, double* to) { *to = index(g, c[i], lc[i]); });
  });
}

}  // namespace

void bind_conditioning(py::module_& m) {
  bind_index(m, "condition_number_two", [](const Geometry& g, const Configuration& c, double lc) {
    return condition_number(g, c, lc, Norm::two);
  });
  bind_index(m, "condition_number_frobenius", [](const Geometry& g, const Configuration& c, double lc) {
    return condition_number(g, c, lc, Norm::frobenius);
  });
  bind_index(m, "reciprocal_condition_number", [](const Geometry& g, const Configuration& c, double lc) {
    return reciprocal_condition_number(g, c, lc);
  });
  bind_index(m, "manipulability", &manipulability);
  bind_index(m, "isotropy_residual", &isotropy_residual);

  m.def("singular_values",
        [](const Geometry& g, const Array& p, const Array& q, const Array& s, const Array& length, int threads) {
          const ConfigurationStack c(p, q, s);
          const Lengths lc(length, c.count());
          return for_each_row(c.count(), 6, threads, py::none(),
                              [&](long i, double* out) { Eigen::Map<Vec6>{out} = singular_values(g, c[i], lc[i]); });
        });
  m.def("axis_singular_values",
        [](const Geometry& g, const Array& p, const Array& q, const Array& s, const Array& length, int threads) {
          const ConfigurationStack c(p, q, s);
          const Lengths lc(length, c.count());
          return for_each_row(c.count(), 6, threads, py::none(), [&](long i, double* out) {
            const Configuration pose = c[i];
            Vec6 sigma;
            if (pose.position.hasNaN() || pose.rotation.hasNaN() || pose.internal_point.hasNaN()) {
              Eigen::Map<Vec6>{out} = sigma.setConstant(std::numeric_limits<double>::quiet_NaN());
              return;
            }
            const AxisSpectrum<double> a = axis_spectrum(axis_design(g, pose), lc[i]);
            sigma << a.axial_max, a.axial_min, a.transverse_max, a.transverse_max, a.transverse_min, a.transverse_min;
            sigma = sigma.cwiseInverse().eval();
            if (!sigma.hasNaN()) std::sort(sigma.begin(), sigma.end(), std::greater<>());
            Eigen::Map<Vec6>{out} = sigma;
          });
        });
  m.def("characteristic_length",
        [](const Geometry& g, const Array& p, const Array& q, const Array& s, const std::string& kind, int threads) {
          const ConfigurationStack c(p, q, s);
          const LengthKind k = length_kind(kind);
          return for_each_row(c.count(), 1, threads, py::none(),
                              [&](long i, double* out) { *out = characteristic_length(g, c[i], k); });
        });
}

}  // namespace ninedof::python
