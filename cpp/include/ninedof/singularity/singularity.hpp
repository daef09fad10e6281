#pragma once
/// Where locked legs no longer hold the robot: which mechanism gives way, how it then moves, and how far off that is.
///
/// det H = -det M det C det B / l_c^3 (theory of position and velocity, section 5): three independent ways to lose control,
/// each the determinant of a 3x3 matrix of rows without unit.
///
///   M  rows d^_i x w^_i, the unit vectors from O to the base and to the platform joint of external leg i. Lost where the
///      planes (O, A_i, B_i) share a line through O: the platform turns about it.
///   B  rows e^_i. Lost where O lies in the plane of the lower joints: O leaves that plane and drags the platform along.
///   C  rows e~_i. Lost where O lies in the platform's plane of upper joints: the platform moves past a still O.
///
/// A joint at O has no direction from O, a leg of zero length none of its own; "zero" is what is below the rounding of the
/// coordinates. Such a row is zero and its mechanism counts as lost.

#include <vector>

#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

enum class Mechanism { none, m, b, c };

/// "", "m", "b" or "c".
const char* to_string(Mechanism mechanism);

/// A number for each mechanism.
struct PerMechanism {
  double m, b, c;
};

/// The signed determinants, in [-1, 1]. They change sign across a singularity and do not depend on the length unit.
///
/// m is the Jacobian determinant of the rotation problem d^_i . Q w^_i = cos_i; the theory's det M, of rows w_i x e_i, is
/// m |d_1||w_1||d_2||w_2||d_3||w_3| / (l_1 l_2 l_3). All NaN for a configuration that has NaN.
PerMechanism singularity_margins(const Geometry& g, const Configuration& c);

/// What is weakest here.
struct SingularityReport {
  PerMechanism margins;
  PerMechanism sigma;   ///< smallest singular values of the three matrices: how far each is from a singular one
  Mechanism
      mechanism;  ///< of the least sigma; of those lost to rounding the first of m, c, b. `none` where there is NaN
  Velocity motion;      ///< what the legs of that mechanism notice least, no other leg noticing it at all
};

/// The motion is (omega, pdot, sdot), base frame, its sign arbitrary:
///   M  sdot = 0, pdot = y x omega with y = s - p: a turn about a line through O, only ldot differs from 0;
///   C  sdot = 0: only qdot differs from 0;          B  sdot normal to the lower plane: only rdot differs from 0.
/// It is as long as a turn by one radian: |omega|^2 + (|v_O|^2 + |sdot|^2) / L^2 = 1, v_O = pdot + omega x y the velocity of
/// the platform's point at O, L the root mean square distance of the six platform joints from O. So it is the same motion of
/// the robot in any length unit. NaN where the mechanism is lost to a leg of zero length: such a leg locks whatever moves it.
SingularityReport singularity(const Geometry& g, const Configuration& c);

/// Every independent motion that the nine legs do not notice: those of the singular values of H up to `tolerance`, least
/// first, with H acting on (L omega, v_O, sdot); orthonormal in the measure above. Empty where the robot is under control.
///
/// Unlike `singularity` it does not ask for the mechanism: when several are lost together, some of the motions may be lost
/// to each other. A leg of zero length holds its two ends together and stands for three rows of H.
/// Throws InvalidArgument unless the tolerance is finite and positive, and for a configuration that has NaN.
std::vector<Vec9> uncontrolled_motions(const Geometry& g, const Configuration& c, double tolerance = 1e-9);

/// How far it is to the first singular configuration on a path.
struct SingularityDistance {
  double distance;      ///< least of `each`; infinite where the whole path is free
  Mechanism mechanism;  ///< of that distance; of equal ones the first of m, c, b
  PerMechanism each;    ///< the same for each mechanism alone
  bool resolved;        ///< false: the path is free up to `distance`, and what lies beyond was not settled
};

/// The smallest t of [0, most] at which plus(c, t direction) is singular, `direction` being (omega, pdot, sdot).
///
/// Nothing is stepped over: each step keeps to a lower bound of |det| from its derivatives, rounding included. A zero that is
/// only touched is found where |det| sinks below its rounding error, which puts it off by about the square root of that.
/// NaN throughout for a configuration or a direction that has NaN.
/// Throws InvalidArgument for an infinite direction, and unless `most` is finite and positive.
SingularityDistance distance_to_singularity(const Geometry& g, const Configuration& c, const Vec9& direction,
                                            double most = 1.0);

}  // namespace ninedof
