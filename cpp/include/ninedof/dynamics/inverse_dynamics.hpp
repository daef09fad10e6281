#pragma once
/// Leg forces of a machine in motion: weights and inertia of its bodies as one load (docs/theory/dynamics.md).
///
/// Each leg is two bodies that are thin about its axis: a cylinder at the end where the leg starts and a rod at the
/// other. External legs start at the base, lower internal ones at the base, upper internal ones at the platform; O is
/// the other end of both kinds of internal legs. A leg does not resist its turning about itself.
///
/// By d'Alembert a body acts on the machine as the load weight - mass x acceleration. The virtual work of all bodies
/// for a motion (omega, pdot, sdot) is that of one Load on platform and O, which `leg_forces` balances.

#include "ninedof/kinematics/acceleration.hpp"
#include "ninedof/statics/statics.hpp"

namespace ninedof {

/// Masses >= 0, in any unit that goes with those of length and time: a force is mass x length / time^2.
struct Masses {
  double platform = 0.0;          ///< with what it carries
  Vec3 centre = Vec3::Zero();     ///< of the platform's mass, platform frame
  Mat3 inertia = Mat3::Zero();    ///< of the platform about that centre, platform frame
  Vec9 cylinder = Vec9::Zero();   ///< of each leg, at the end where it starts
  Vec9 rod = Vec9::Zero();        ///< of each leg, at the other end
  Vec9 cylinder_centre = Vec9::Zero();   ///< distance of the cylinder's centre of mass from the leg's start
  Vec9 rod_centre = Vec9::Zero();        ///< distance of the rod's centre of mass from the leg's other end
  Vec9 cylinder_inertia = Vec9::Zero();  ///< about an axis across the leg, through the centre of mass
  Vec9 rod_inertia = Vec9::Zero();       ///< likewise
  double internal_point = 0.0;    ///< a point mass at O
};

/// Throws InvalidArgument for a mass or inertia that is negative or infinite, and for centres that are infinite.
void validate(const Masses& m);

/// Position, velocity and acceleration of the machine.
struct MotionState {
  Configuration at;
  Velocity velocity{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  Acceleration acceleration{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
};

/// Weights and inertia of all bodies as one load. `gravity`: force per mass, base axes. At rest the weights alone. NaN
/// for a leg of zero length with a mass or an inertia: it has no direction.
Load inertial_load(const Geometry& g, const MotionState& motion, const Masses& masses, const Vec3& gravity);

/// The leg forces that make this motion against `load`, positive if a leg pushes. As leg_forces where singular.
LegForces inverse_dynamics(const Geometry& g, const MotionState& motion, const Masses& masses, const Vec3& gravity,
                           const Load& load = {});

inline Load operator+(const Load& a, const Load& b) {
  return {a.moment + b.moment, a.force + b.force, a.force_at_o + b.force_at_o};
}

}  // namespace ninedof
