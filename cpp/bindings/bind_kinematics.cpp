#include "arrays.hpp"
#include "lengths.hpp"
#include "module.hpp"
#include "ninedof/legs.hpp"
#include "ninedof/velocity.hpp"

namespace ninedof::python {
namespace {

/// Writes a matrix row-major at `to`; returns the place after it.
template <class Derived>
double* write(const Eigen::MatrixBase<Derived>& m, double* to) {
  using RowMajor = Eigen::Matrix<double, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime,
                                 Derived::ColsAtCompileTime == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  Eigen::Map<RowMajor> view(to);
  view = m;
  return to + m.size();
}

/// Nine numbers for each configuration.
void require_rows(const std::string& name, const Array& a, long count) {
  if (a.size() != 9 * count)
    throw InvalidArgument(name, std::to_string(a.size()) + " numbers", std::to_string(9 * count));
}

/// A..G of every configuration, one after the other: 18 + 9 + 9 + 9 + 18 + 36 + 54 doubles.
constexpr py::ssize_t matrices_size = 153;

}  // namespace

void bind_kinematics(py::module_& m) {
  m.def("leg_lengths", [](const Geometry& g, const Array& p, const Array& q, const Array& s, int threads) {
    const ConfigurationStack c(p, q, s);
    return for_each_row(c.count(), 9, threads, py::none(),
                        [&](long i, double* out) { write(leg_lengths(g, c[i]), out); });
  });
  m.def("jacobian",
        [](const Geometry& g, const Array& p, const Array& q, const Array& s, const Array& length, int threads) {
          const ConfigurationStack c(p, q, s);
          const Lengths lc(length, c.count());
          return for_each_row(c.count(), 54, threads, py::none(),
                              [&](long i, double* out) { write(jacobian(g, c[i], lc[i]), out); });
        });
  m.def("velocity_matrices",
        [](const Geometry& g, const Array& p, const Array& q, const Array& s, const Array& length, int threads) {
          const ConfigurationStack c(p, q, s);
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
  m.def("forward_velocity",
        [](const Geometry& g, const Array& p, const Array& q, const Array& s, const Array& rates, int threads) {
          const ConfigurationStack c(p, q, s);
          require_rows("leg_rates", rates, c.count());
          const double* r = rates.data();
          return for_each_row(c.count(), 9, threads, py::none(), [&](long i, double* out) {
            const Velocity v = forward_velocity(g, c[i], Eigen::Map<const Vec9>(r + 9 * i));
            write(v.sdot, write(v.pdot, write(v.omega, out)));
          });
        });
  m.def("inverse_velocity", [](const Geometry& g, const Array& p, const Array& q, const Array& s, const Array& velocity,
                               int threads) {
    const ConfigurationStack c(p, q, s);
    const double* v = velocity.data();
    return for_each_row(c.count(), 9, threads, py::none(), [&](long i, double* out) {
      const double* at = v + 9 * i;
      write(inverse_velocity(
                g, c[i], {Eigen::Map<const Vec3>(at), Eigen::Map<const Vec3>(at + 3), Eigen::Map<const Vec3>(at + 6)}),
            out);
    });
  });
}

}  // namespace ninedof::python
