#pragma once
/// Forces in the legs and stiffness of the machine, by virtual work.
///
/// A leg force is positive where the leg pushes, that is, works to become longer. With H of eqs. (24)-(26), udot = H x
/// for x = (omega, pdot, sdot), legs at forces f feed in the power f.udot, so they balance a load (moment, force, force
/// at O) if H^T f + load = 0. H is 9x9: apart from singular configurations there is one such f, and the redundancy of
/// the nine legs leaves no choice; it lies in the position of O.

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// What acts on the machine from outside, base axes: moment about p and force on the platform, force on O.
struct Load {
  Vec3 moment = Vec3::Zero();
  Vec3 force = Vec3::Zero();
  Vec3 force_at_o = Vec3::Zero();
};

struct LegForces {
  Vec9 forces;      ///< l1 l2 l3 q1 q2 q3 r1 r2 r3, positive where the leg pushes
  Load unbalanced;  ///< what no leg forces carry; exactly zero unless the configuration is singular
};

/// The leg forces that balance a load. At a singular configuration those of least norm that balance load - unbalanced,
/// where `unbalanced` is the part of the load that works on the motions which locked legs leave free (orthogonal
/// projection, moments divided by the platform radius). NaN where the configuration or the load has NaN.
LegForces leg_forces(const Geometry& g, const Configuration& c, const Load& load);

/// As many columns as there are independent self-stresses.
using SelfStress = Eigen::Matrix<double, 9, Eigen::Dynamic, Eigen::ColMajor, 9, 9>;

/// Columns: an orthonormal basis of the leg forces that are in balance without a load, the entry of largest modulus
/// positive. No column at a regular configuration. A leg of zero length has no direction, and a column of its own. One
/// column of NaN where the configuration has NaN.
SelfStress self_stress(const Geometry& g, const Configuration& c);

/// Stiffness of the platform with O free to settle, 6x6: (moment about p, force) that a small displacement (rotation,
/// translation) needs when legs of the given stiffness (force/length, >= 0) start without load. Symmetric, positive
/// semidefinite.
///
/// It is the Schur complement of `stiffness_with_o`, made by an orthogonal factorization and not by inverting: at a
/// singular configuration it is finite and singular. Throws InvalidArgument for a stiffness that is negative or
/// infinite.
Mat6 stiffness(const Geometry& g, const Configuration& c, const Vec9& leg_stiffness);

/// H^T diag(k) H, 9x9: the same with O held as well, displacements (rotation, p, s).
Mat9 stiffness_with_o(const Geometry& g, const Configuration& c, const Vec9& leg_stiffness);

}  // namespace ninedof
