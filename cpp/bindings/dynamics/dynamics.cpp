#include "ninedof/dynamics/inverse_dynamics.hpp"
#include "ninedof/dynamics/payload.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

/// Nine numbers as a Velocity or an Acceleration.
template <class T>
T three_vectors(const double* from) {
  return {Eigen::Map<const Vec3>(from), Eigen::Map<const Vec3>(from + 3), Eigen::Map<const Vec3>(from + 6)};
}

void bind_masses(py::module_& m) {
  request<Masses>(m, "Masses", "Masses of the platform, of the two bodies of each leg and of O.")
      .def_readwrite("platform", &Masses::platform, "With what it carries.")
      .def_readwrite("centre", &Masses::centre, "Platform frame.")
      .def_readwrite("inertia", &Masses::inertia, "About the centre, platform frame.")
      .def_readwrite("cylinder", &Masses::cylinder, "Shape (9,), as the rest of the legs.")
      .def_readwrite("rod", &Masses::rod, "Shape (9,).")
      .def_readwrite("cylinder_centre", &Masses::cylinder_centre, "From the leg's start.")
      .def_readwrite("rod_centre", &Masses::rod_centre, "From the leg's other end.")
      .def_readwrite("cylinder_inertia", &Masses::cylinder_inertia, "Across the leg, about the centre.")
      .def_readwrite("rod_inertia", &Masses::rod_inertia, "Across the leg, about the centre.")
      .def_readwrite("internal_point", &Masses::internal_point, "A point mass at O.");
}

}  // namespace

void bind_dynamics(py::module_& m) {
  bind_masses(m);
  // Rows of 27: velocity (omega, pdot, sdot), acceleration, load (moment, force, force at O).
  m.def("inverse_dynamics", [](const Geometry& g, const ConfigurationStack& c, const Array& motion,
                               const Masses& masses, const Vec3& gravity, int threads) {
    const double* from = rows("motion", motion, c.count(), 27);
    validate(masses);
    return for_each_row(c.count(), 27, threads, py::none(), [&](long i, double* out) {
      const double* row = from + 27 * i;
      const MotionState state{c[i], three_vectors<Velocity>(row), three_vectors<Acceleration>(row + 9)};
      const LegForces f = inverse_dynamics(g, state, masses, gravity, three_vectors<Load>(row + 18));
      Eigen::Map<Eigen::Matrix<double, 27, 1>>{out} << f.forces, inverse_velocity(g, state.at, state.velocity),
          f.unbalanced.moment, f.unbalanced.force, f.unbalanced.force_at_o;
    });
  });
  // Rows of 36: forces without the payload, of a unit of it, greatest pushes and pulls.
  m.def("payload_shares", [](const Array& instants, int threads) {
    const long count = static_cast<long>(instants.shape(0));
    const double* from = rows("instants", instants, count, 36);
    return for_each_row(count, 18, threads, py::none(), [&](long i, double* out) {
      const Eigen::Map<const Eigen::Matrix<double, 9, 4>> row(from + 36 * i);
      Eigen::Map<Vec18>{out} = payload_shares(Vec9(row.col(0)), Vec9(row.col(1)), Vec9(row.col(2)), Vec9(row.col(3)));
    });
  });
}

}  // namespace ninedof::python
