#include "ninedof/dynamics/inverse_dynamics.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

struct PointMotion {
  Vec3 velocity, acceleration;
};

/// The forces of a leg's bodies at its two ends.
struct EndForces {
  Vec3 start, other;
};

/// Both bodies of leg k along its unit vector e. Their centres are start + a e and other - b e; with forces f_c and f_r
/// there, and -I edd for a thin body that turns, the virtual work of a displacement of the ends is
///     f_c.d(start) + f_r.d(other) + t.de,    t = a f_c - b f_r - (I_c + I_r) edd,   de = (1 - e e^T) d(other - start)
/// / l
EndForces of_leg(Eigen::Index k, const Vec3& e, double length, const PointMotion& start, const PointMotion& other,
                 const Masses& m, const Vec3& gravity) {
  if (m.cylinder[k] == 0.0 && m.rod[k] == 0.0 && m.cylinder_inertia[k] == 0.0 && m.rod_inertia[k] == 0.0)
    return {Vec3::Zero(), Vec3::Zero()};
  const auto across = [&e](const Vec3& v) { return Vec3(v - e.dot(v) * e); };
  const Vec3 apart = other.velocity - start.velocity;
  const Vec3 ed = across(apart) / length;
  const Vec3 edd =
      (across(other.acceleration - start.acceleration) - 2.0 * e.dot(apart) * ed) / length - ed.squaredNorm() * e;
  const double a = m.cylinder_centre[k], b = m.rod_centre[k];
  const Vec3 cylinder = m.cylinder[k] * (gravity - start.acceleration - a * edd);
  const Vec3 rod = m.rod[k] * (gravity - other.acceleration + b * edd);
  const Vec3 turning = across(a * cylinder - b * rod - (m.cylinder_inertia[k] + m.rod_inertia[k]) * edd) / length;
  return {cylinder - turning, rod + turning};
}

/// The platform alone: Newton and Euler about its centre of mass, as a load about p.
Load of_platform(const MotionState& motion, const Masses& m, const Vec3& gravity) {
  const auto& [omega, pdot, sdot] = motion.velocity;
  const auto& [alpha, pddot, sddot] = motion.acceleration;
  const Mat3& q = motion.at.rotation;
  const Vec3 arm = q * m.centre;
  const Vec3 force = m.platform * (gravity - pddot - alpha.cross(arm) - omega.cross(omega.cross(arm)));
  const Mat3 inertia = q * m.inertia * q.transpose();
  return {arm.cross(force) - inertia * alpha - omega.cross(inertia * omega), force, Vec3::Zero()};
}

void require_no_less(const char* name, double value) {
  if (!(value >= 0.0) || std::isinf(value)) throw InvalidArgument(name, format_number(value), "finite numbers >= 0");
}

}  // namespace

void validate(const Masses& m) {
  require_no_less("platform", m.platform);
  require_no_less("internal_point", m.internal_point);
  for (int k = 0; k < 9; ++k) {
    require_no_less("cylinder", m.cylinder[k]);
    require_no_less("rod", m.rod[k]);
    require_no_less("cylinder_inertia", m.cylinder_inertia[k]);
    require_no_less("rod_inertia", m.rod_inertia[k]);
    require_finite("cylinder_centre", m.cylinder_centre[k]);
    require_finite("rod_centre", m.rod_centre[k]);
  }
  for (const double value : m.centre) require_finite("centre", value);
  for (const double value : m.inertia.reshaped()) require_finite("inertia", value);
}

Load inertial_load(const Geometry& g, const MotionState& motion, const Masses& masses, const Vec3& gravity) {
  const Legs k = legs(g, motion.at);
  const auto& [omega, pdot, sdot] = motion.velocity;
  const auto& [alpha, pddot, sddot] = motion.acceleration;
  const auto on_platform = [&](const Vec3& u) {
    return PointMotion{pdot + omega.cross(u), pddot + alpha.cross(u) + omega.cross(omega.cross(u))};
  };
  const PointMotion at_rest{Vec3::Zero(), Vec3::Zero()}, o{sdot, sddot};
  Load out = of_platform(motion, masses, gravity);
  out.force_at_o += masses.internal_point * (gravity - sddot);
  const auto push = [&out](const Vec3& u, const Vec3& force) {
    out.moment += u.cross(force);
    out.force += force;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const EndForces l = of_leg(row, k.e[i], k.l[row], at_rest, on_platform(k.u[i]), masses, gravity);
    push(k.u[i], l.other);
    const EndForces q = of_leg(row + 3, k.e_tilde[i], k.q[row], on_platform(k.u_tilde[i]), o, masses, gravity);
    push(k.u_tilde[i], q.start);
    out.force_at_o += q.other;
    out.force_at_o += of_leg(row + 6, k.e_hat[i], k.r[row], at_rest, o, masses, gravity).other;
  }
  return out;
}

LegForces inverse_dynamics(const Geometry& g, const MotionState& motion, const Masses& masses, const Vec3& gravity,
                           const Load& load) {
  return leg_forces(g, motion.at, load + inertial_load(g, motion, masses, gravity));
}

}  // namespace ninedof
