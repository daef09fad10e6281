#include "ninedof/statics/ellipsoid.hpp"

#include "support/arrays.hpp"
#include "support/lengths.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

/// Writes the directions, row-major, then the semi-axes.
template <int N>
void write(const Ellipsoid<N>& e, double* out) {
  Eigen::Map<Eigen::Matrix<double, N, N, Eigen::RowMajor>>{out} = e.directions;
  Eigen::Map<Eigen::Matrix<double, N, 1>>{out + N* N} = e.semi_axes;
}

/// Binds `make(geometry, configuration, characteristic length)` over a stack.
template <int N, class Make>
void bind_rows(py::module_& m, const char* name, Make make) {
  m.def(name, [make](const Geometry& g, const ConfigurationStack& c, const Array& length, int threads) {
    const Lengths lc(length, c.count());
    return for_each_row(c.count(), N * N + N, threads, py::none(),
                        [&](long i, double* out) { write<N>(make(g, c[i], lc[i]), out); });
  });
}

}  // namespace

void bind_ellipsoid(py::module_& m) {
  using G = const Geometry&;
  using C = const Configuration&;
  bind_rows<6>(m, "velocity_ellipsoid_twist", [](G g, C c, double lc) { return velocity_ellipsoid(g, c, lc); });
  bind_rows<3>(m, "velocity_ellipsoid_rotation",
               [](G g, C c, double lc) { return velocity_ellipsoid(g, c, TwistPart::rotation, lc); });
  bind_rows<3>(m, "velocity_ellipsoid_translation",
               [](G g, C c, double lc) { return velocity_ellipsoid(g, c, TwistPart::translation, lc); });
  bind_rows<6>(m, "force_ellipsoid_twist", [](G g, C c, double lc) { return force_ellipsoid(g, c, lc); });
  bind_rows<3>(m, "force_ellipsoid_rotation",
               [](G g, C c, double lc) { return force_ellipsoid(g, c, TwistPart::rotation, lc); });
  bind_rows<3>(m, "force_ellipsoid_translation",
               [](G g, C c, double lc) { return force_ellipsoid(g, c, TwistPart::translation, lc); });
}

}  // namespace ninedof::python
