#pragma once
/// Leg forces and stiffness, by virtual work (docs/theory/statics.md).
///
/// A leg force is positive if the leg pushes. With H of eqs. (24)-(26), udot = H x for x = (omega, pdot, sdot), the leg
/// forces f have the power f.udot, so they balance a load (moment, force, force at O) if H^T f + load = 0. H is 9x9: at
/// a regular configuration f is unique. The redundancy lies in the choice of O and not in the forces.

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// External load in base axes: moment about p and force on the platform, force on O.
struct Load {
  Vec3 moment = Vec3::Zero();
  Vec3 force = Vec3::Zero();
  Vec3 force_at_o = Vec3::Zero();
};

/// The platform with what it carries.
struct Weight {
  double mass = 0.0;
  Vec3 centre = Vec3::Zero();   ///< of mass, platform frame
  Vec3 gravity = Vec3::Zero();  ///< force per mass, base axes

  Load at(const Mat3& rotation) const {
    return {(rotation * centre).cross(mass * gravity), mass * gravity, Vec3::Zero()};
  }
};

struct LegForces {
  Vec9 forces;      ///< l1 l2 l3 q1 q2 q3 r1 r2 r3, positive if the leg pushes
  Load unbalanced;  ///< the part that no leg forces balance; exactly zero unless the configuration is singular

  bool balanced() const {
    return unbalanced.moment.isZero(0.0) && unbalanced.force.isZero(0.0) && unbalanced.force_at_o.isZero(0.0);
  }
};

/// The leg forces that balance a load. At a singular configuration those of least norm that balance load - unbalanced,
/// where `unbalanced` is the part of the load that works on the free motions (orthogonal projection, with moments
/// divided by the platform radius). NaN if the configuration or the load has NaN.
LegForces leg_forces(const Geometry& g, const Configuration& c, const Load& load);

/// One column for each independent self-stress.
using SelfStress = Eigen::Matrix<double, 9, Eigen::Dynamic, Eigen::ColMajor, 9, 9>;

/// Columns: an orthonormal basis of the leg forces that are in equilibrium without a load, the entry of largest modulus
/// positive. No column at a regular configuration. A leg of zero length has no direction and contributes a column. One
/// column of NaN if the configuration has NaN.
SelfStress self_stress(const Geometry& g, const Configuration& c);

/// Stiffness of the platform with O free, 6x6: the (moment about p, force) for a small displacement (rotation,
/// translation), for legs of the given stiffness (force/length, >= 0) without preload. Symmetric, positive
/// semidefinite.
///
/// The Schur complement of `stiffness_with_o`, computed by an orthogonal factorization without an inverse: at a
/// singular configuration it is finite and singular. Throws InvalidArgument for a stiffness that is negative or
/// infinite.
Mat6 stiffness(const Geometry& g, const Configuration& c, const Vec9& leg_stiffness);

/// The least stiffness over directions: of a shift, the platform free to turn, and of a turn, free to shift.
struct LeastStiffness {
  double shift, turn;
};
LeastStiffness least_stiffness(const Geometry& g, const Configuration& c, const Vec9& leg_stiffness);

/// H^T diag(k) H, 9x9: the same for displacements (rotation, p, s) of platform and O.
Mat9 stiffness_with_o(const Geometry& g, const Configuration& c, const Vec9& leg_stiffness);

}  // namespace ninedof
