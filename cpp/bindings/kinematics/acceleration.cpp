#include "support/lengths.hpp"
#include "support/module.hpp"
#include "support/motion.hpp"

namespace ninedof::python {

void bind_acceleration(py::module_& m) {
  m.def("forward_acceleration", [](const Geometry& g, const ConfigurationStack& c, const Array& rates,
                                   const Array& accelerations, int threads) {
    const double* r = rows("leg_rates", rates, c.count(), 9);
    const double* a = rows("leg_accelerations", accelerations, c.count(), 9);
    return for_each_row(c.count(), 9, threads, py::none(), [&](long i, double* out) {
      const Eigen::Map<const Vec9> leg_rates(r + 9 * i), leg_accelerations(a + 9 * i);
      write(forward_acceleration(g, c[i], leg_rates, leg_accelerations), out);
    });
  });
  m.def("inverse_acceleration", [](const Geometry& g, const ConfigurationStack& c, const Array& velocity,
                                   const Array& acceleration, int threads) {
    const double* v = rows("velocity", velocity, c.count(), 9);
    const double* a = rows("acceleration", acceleration, c.count(), 9);
    return for_each_row(c.count(), 9, threads, py::none(), [&](long i, double* out) {
      write(inverse_acceleration(g, c[i], velocity_at(v + 9 * i), acceleration_at(a + 9 * i)), out);
    });
  });
  m.def("jacobian_rate",
        [](const Geometry& g, const ConfigurationStack& c, const Array& velocity, const Array& length, int threads) {
          const Lengths lc(length, c.count());
          const double* v = rows("velocity", velocity, c.count(), 9);
          return for_each_row(c.count(), 54, threads, py::none(), [&](long i, double* out) {
            write(jacobian_rate(g, c[i], velocity_at(v + 9 * i), lc[i]), out);
          });
        });
}

}  // namespace ninedof::python
