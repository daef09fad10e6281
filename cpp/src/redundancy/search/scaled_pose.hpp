#pragma once
/// One pose in scaled coordinates: the fixed joints, and the singularity surfaces that O must not cross.

#include <Eigen/Geometry>
#include <array>

#include "ninedof/redundancy/redundancy.hpp"
#include "ninedof/robot/geometry.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

/// A function of O to second order: value, gradient and Hessian at one point.
struct Jet {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();

  /// Adds `weight` times another.
  void add(double weight, const Jet& other) {
    value += weight * other.value;
    gradient += weight * other.gradient;
    hessian += weight * other.hessian;
  }
  /// Adds f(other), given f and its first two derivatives there.
  void add_function(double f, double slope, double curvature, const Jet& other) {
    value += f;
    gradient += slope * other.gradient;
    hessian += slope * other.hessian + curvature * (other.gradient * other.gradient.transpose());
  }
};

/// A limit for each joint of ScaledPose::joint.
using Vec12 = Eigen::Matrix<double, 12, 1>;

/// Least distance of O from an external joint, in sizes of the robot, for Criterion::singularity. det N has no limit
/// there: d^_i takes every direction, and on the smallest sphere around the joint det N has every value down to 0. A
/// large det N next to a joint is therefore next to a singularity.
constexpr double joint_clearance = 0.05;

/// Coordinates of O from the middle of the joints, in sizes of the robot: one set of tolerances serves every robot.
class ScaledPose {
 public:
  ScaledPose(const Geometry& g, const Vec3& position, const Mat3& rotation, const InternalPointProblem& problem);

  /// The configuration with O at x, in the caller's units.
  Configuration configuration(const Vec3& x) const { return {position_, rotation_, unscaled(x)}; }
  const Geometry& geometry() const { return geometry_; }
  const Vec3& position() const { return position_; }
  const Mat3& rotation() const { return rotation_; }

  /// The size of the robot, and coordinates in lengths (s) and in that unit (x).
  double unit() const { return unit_; }
  Vec3 scaled(const Vec3& s) const { return (s - origin_) / unit_; }
  Vec3 unscaled(const Vec3& x) const { return origin_ + unit_ * x; }

  double characteristic_length() const { return characteristic_length_; }
  /// Limits of the distance of O from joint k: of the internal legs, and for the criterion of the determinants a least
  /// distance from the external joints (see joint_clearance).
  const Vec12& low() const { return low_; }
  const Vec12& high() const { return high_; }
  /// The far ends of q1 q2 q3 r1 r2 r3, then the joints r1 r2 r3 u1 u2 u3 of the external legs.
  const Vec3& joint(int k) const {
    constexpr std::array first{point_u_tilde, point_r_hat, point_r, point_u};
    return at_[at_index(first[at_index(k / 3)] + k % 3)];
  }

  /// All points with O at x.
  Points points(const Vec3& x) const;

  /// det B, det C and det N of singularity.hpp times the lengths of their vectors: of degree 1, 1 and 3 in x.
  Vec3 volumes(const Vec3& x) const;

  /// The three determinants, each in [-1, 1]; 0 where x is a joint.
  Vec3 determinants(const Vec3& x) const;

  /// Logarithms of the three |det|, with derivatives.
  std::array<Jet, 3> log_determinants(const Vec3& x) const;

  /// The first t of (0, most] at which x + t d meets a singularity, `most` where there is none. The roots are those of
  /// the polynomials along the line, so that no singularity is stepped over.
  double step_to_singularity(const Vec3& x, const Vec3& d, double most) const;

 private:
  /// Row i of the third volume: d_i x w_i = (r_i - x) x (u_i - x), of first degree in x.
  Vec3 turning_row(int i, const Vec3& x) const { return moment_[at_index(i)] + span_[at_index(i)].cross(x); }

  const Geometry& geometry_;
  Vec3 position_;
  Mat3 rotation_;
  Points at_;
  Vec3 origin_ = Vec3::Zero();
  double unit_ = 1.0, characteristic_length_ = 1.0;
  Vec12 low_, high_;
  Triple moment_, span_;  ///< r_i x u_i and u_i - r_i
  /// Normals of the planes of the lower and of the upper joints; their length is the area of the parallelogram.
  std::array<Vec3, 2> normal_;
};

}  // namespace ninedof
