#pragma once
/// Velocities and accelerations, nine numbers in the order of the twist: rotation, platform origin, O.

#include "ninedof/kinematics/acceleration.hpp"
#include "ninedof/kinematics/velocity.hpp"
#include "support/configurations.hpp"

namespace ninedof::python {

inline Velocity velocity_at(const double* v) {
  return {Eigen::Map<const Vec3>(v), Eigen::Map<const Vec3>(v + 3), Eigen::Map<const Vec3>(v + 6)};
}
inline Acceleration acceleration_at(const double* a) {
  return {Eigen::Map<const Vec3>(a), Eigen::Map<const Vec3>(a + 3), Eigen::Map<const Vec3>(a + 6)};
}

inline double* write(const Velocity& v, double* to) {
  return write(v.sdot, write(v.pdot, write(v.omega, to)));
}
inline double* write(const Acceleration& a, double* to) {
  return write(a.sddot, write(a.pddot, write(a.alpha, to)));
}

}  // namespace ninedof::python
