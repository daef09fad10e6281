#pragma once
/// Singularities: where locked legs no longer hold the robot. Which mechanism is lost, how the robot then moves, and
/// how far away that is.
///
/// det H = -det N' det C det B / l_c^3 (docs/theory/singularity.md), N' with rows w_i x e_i. Each
/// factor is an independent singularity. The project measures it by one determinant of three rows without unit, in [-1,
/// 1]:
///
///   det N  rows d^_i x w^_i, with d^_i and w^_i the unit vectors from O to the base joint and to the platform joint of
///          external leg i. Zero where the planes (O, A_i, B_i) share a line through O: the platform turns about it.
///          det N' = det N |d_1||w_1||d_2||w_2||d_3||w_3| / (l_1 l_2 l_3).
///   det B  rows e^_i. Zero where O lies in the plane of the lower joints: O leaves it and takes the platform along.
///   det C  rows e~_i. Zero where O lies in the plane of the upper joints: the platform moves and O does not.
///
/// The report, the design constraint singularity_free, the internal-point search and workspaces all use these values.
/// A joint at O has no direction from O, and a leg of zero length has no direction; "zero" means below the rounding of
/// the coordinates. Such a row is zero and its mechanism counts as lost.

#include <stop_token>
#include <vector>

#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

enum class Mechanism { none, n, b, c };

/// "", "n", "b" or "c".
const char* to_string(Mechanism mechanism);

/// A number for each mechanism.
struct PerMechanism {
  double n, b, c;
};

/// The signed determinants, in [-1, 1]. They change sign across a singularity and do not depend on the length unit.
///
/// n is also the Jacobian determinant of the rotation problem d^_i . Q w^_i = cos_i. All NaN for a configuration that
/// has NaN.
PerMechanism singularity_margins(const Geometry& g, const Configuration& c);

/// The weakest mechanism of a configuration.
struct SingularityReport {
  PerMechanism margins;
  PerMechanism sigma;   ///< smallest singular values of the three matrices: how far each is from a singular one
  Mechanism
      mechanism;  ///< of the least sigma; of those lost to rounding the first of n, c, b. `none` where there is NaN
  Velocity motion;      ///< the motion that changes the legs of that mechanism least, and no other leg
};

/// The motion is (omega, pdot, sdot), base frame, its sign arbitrary:
///   N  sdot = 0, pdot = y x omega with y = s - p: a turn about a line through O, only ldot differs from 0;
///   C  sdot = 0: only qdot differs from 0;          B  sdot normal to the lower plane: only rdot differs from 0.
/// Its length is that of a turn by one radian: |omega|^2 + (|v_O|^2 + |sdot|^2) / L^2 = 1, with v_O = pdot + omega x y
/// the velocity of the platform's point at O and L the root mean square distance of the six platform joints from O. So
/// it is the same motion of the robot in any length unit. NaN where a leg of zero length is the cause: such a leg locks
/// every motion of its ends against each other.
SingularityReport singularity(const Geometry& g, const Configuration& c);

/// Every independent motion that changes no leg length: the right singular vectors of H for singular values up to
/// `tolerance`, smallest first, with H acting on (L omega, v_O, sdot); orthonormal in the measure above. Empty away
/// from singularities.
///
/// It does not separate mechanisms as `singularity` does: where several are lost together, motions may combine them. A
/// leg of zero length holds its two ends together and stands for three rows of H. Throws InvalidArgument unless the
/// tolerance is finite and positive, and for a configuration that has NaN.
std::vector<Vec9> uncontrolled_motions(const Geometry& g, const Configuration& c, double tolerance = 1e-9);

/// The first singular configuration on a path.
struct SingularityDistance {
  double distance;      ///< least of `each`; infinite where the whole path is free
  Mechanism mechanism;  ///< of that distance; of equal ones the first of n, c, b
  PerMechanism each;    ///< the same for each mechanism alone
  bool resolved;        ///< false: the path is free up to `distance` and undecided beyond
};

/// The smallest t of [0, most] at which plus(c, t direction) is singular, `direction` being (omega, pdot, sdot).
///
/// No zero is stepped over: each step is within a lower bound of |det| from its derivatives, rounding included. A zero
/// without change of sign is found where |det| is below its rounding error; its place is then known to about the square
/// root of that error.
/// NaN throughout for a configuration or a direction that has NaN.
/// Throws InvalidArgument for an infinite direction, and unless `most` is finite and positive.
SingularityDistance distance_to_singularity(const Geometry& g, const Configuration& c, const Vec9& direction,
                                            double most = 1.0);

/// The three-parameter motions whose directions are searched: the tangent (omega, pdot, sdot) is this times a vector.
using Motions = Eigen::Matrix<double, 9, 3>;

/// The nearest singularity in any direction.
struct NearestSingularity {
  double distance;      ///< in the unit of the motions; infinite where none was found up to `most`
  Mechanism mechanism;  ///< lost there, `none` where none was found
  Vec3 direction;       ///< of unit length
  long pose;            ///< of the stack; 0 where none was found
  bool resolved;        ///< see SingularityDistance
};

/// The least of distance_to_singularity over poses and over directions of unit length.
///
/// `directions` evenly spread ones and the axes are looked along from each pose. Then every direction that is the
/// nearest of its neighbours, up to the best 24 of all poses, is turned to where the distance is least. A valley
/// narrower than the first directions may be missed. The result does not depend on the number of threads.
/// Throws InvalidArgument as distance_to_singularity does, for no poses, and for a pose that has NaN. Throws Stopped.
NearestSingularity nearest_singularity(const Geometry& g, const std::vector<Configuration>& poses,
                                       const Motions& motions, double most, int directions = 1000, int threads = 0,
                                       const std::stop_token& stop = {});

/// The nearest singularity for each way of moving, the rest at rest.
struct NearestSingularities {
  NearestSingularity shift;     ///< of the platform, with O or without: length
  NearestSingularity turn;      ///< of the platform about its origin: radians
  NearestSingularity internal;  ///< of O: length
};

/// Up to four times the longest leg, and half a turn. `internal_held`: whether O stays where it is in a shift.
NearestSingularities nearest_singularities(const Geometry& g, const std::vector<Configuration>& poses,
                                           bool internal_held, int threads = 0, const std::stop_token& stop = {});

/// The motions of those: a turn, a shift, or a motion of O along three axes.
struct SingularMotions {
  Motions shift, turn, internal;
};
SingularMotions singular_motions(bool internal_held);

}  // namespace ninedof
