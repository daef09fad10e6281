#include <pybind11/stl.h>

#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/lengths.hpp"
#include "support/module.hpp"
#include "support/motion.hpp"

namespace ninedof::python {
namespace {

/// A to G of one configuration: 18 + 9 + 9 + 9 + 18 + 36 + 54 doubles.
constexpr py::ssize_t matrices_size = 153;

}  // namespace

void bind_kinematics(py::module_& m) {
  m.def("leg_lengths", [](const Geometry& g, const ConfigurationStack& c, int threads, const py::object& out) {
    return for_each_block(c.count(), 9, 1024, threads, out,
                          [&](long first, long last, double* to) { batch::leg_lengths(g, c.view(first, last), to); });
  });
  m.attr("idle_share") = idle_share;
  m.def("idle_legs", [](const Array& shortest, const Array& longest) {
    return idle_legs(Eigen::Map<const Vec9>(rows("shortest", shortest, 1, 9)),
                     Eigen::Map<const Vec9>(rows("longest", longest, 1, 9)));
  });
  m.def("jacobian", [](const Geometry& g, const ConfigurationStack& c, const Array& length, int threads) {
    const Lengths lc(length, c.count());
    return for_each_row(c.count(), 54, threads, py::none(),
                        [&](long i, double* out) { write(jacobian(g, c[i], lc[i]), out); });
  });
  m.def("velocity_matrices", [](const Geometry& g, const ConfigurationStack& c, const Array& length, int threads) {
    const Lengths lc(length, c.count());
    return for_each_row(c.count(), matrices_size, threads, py::none(), [&](long i, double* out) {
      const VelocityMatrices v = velocity_matrices(g, c[i], lc[i]);
      out = write(v.A, out);
      out = write(v.B, out);
      out = write(v.C, out);
      out = write(v.D, out);
      out = write(v.E, out);
      out = write(v.F, out);
      write(v.G, out);
    });
  });
  m.def("forward_velocity", [](const Geometry& g, const ConfigurationStack& c, const Array& rates, int threads) {
    const double* r = rows("leg_rates", rates, c.count(), 9);
    return for_each_row(c.count(), 9, threads, py::none(), [&](long i, double* out) {
      write(forward_velocity(g, c[i], Eigen::Map<const Vec9>(r + 9 * i)), out);
    });
  });
  m.def("inverse_velocity", [](const Geometry& g, const ConfigurationStack& c, const Array& velocity, int threads) {
    const double* v = rows("velocity", velocity, c.count(), 9);
    return for_each_row(c.count(), 9, threads, py::none(),
                        [&](long i, double* out) { write(inverse_velocity(g, c[i], velocity_at(v + 9 * i)), out); });
  });
  m.def("internal_velocity",
        [](const Geometry& g, const ConfigurationStack& c, const Array& twist, const Array& weights, int threads) {
          const double* t = rows("twist", twist, c.count(), 6);
          const double* w = rows("weights", weights, c.count(), 9);
          return for_each_row(c.count(), 3, threads, py::none(), [&](long i, double* out) {
            const Eigen::Map<const Vec3> omega(t + 6 * i), pdot(t + 6 * i + 3);
            write(internal_velocity(g, c[i], omega, pdot, Eigen::Map<const Vec9>(w + 9 * i)), out);
          });
        });
  m.def("null_motion", [](const Geometry& g, const ConfigurationStack& c, int threads) {
    return for_each_row(c.count(), 27, threads, py::none(),
                        [&](long i, double* out) { write(null_motion(g, c[i]), out); });
  });
}

}  // namespace ninedof::python
