#pragma once
/// A limit of the angle between a vector and an axis, for all vectors of a box or of a ball at once.

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "robot/joint_cones.hpp"

namespace ninedof {

/// The vectors within an angle of an axis. Up to a right angle they are a convex cone; beyond it those that are not
/// allowed are one. Every decision holds with `slack` to spare, a length above the rounding.
class ConvexCone {
 public:
  ConvexCone(const Vec3& axis, double angle)
      : allows_(angle <= 0.5 * std::numbers::pi),
        axis_(allows_ ? axis.normalized() : Vec3(-axis.normalized())),
        angle_(allows_ ? angle : std::numbers::pi - angle) {}

  /// Whether all vectors with an end in the box are allowed, or all are not.
  bool allows_box(const Vec3& centre, const Vec3& half, double slack) const {
    return allows_ ? holds_box(centre, half, slack) : misses_box(centre, half, slack);
  }
  bool forbids_box(const Vec3& centre, const Vec3& half, double slack) const {
    return allows_ ? misses_box(centre, half, slack) : holds_box(centre, half, slack);
  }

  /// The distance of v from the nearest vector on the boundary, negative where v is not allowed.
  double clear(const Vec3& v) const {
    const double inside = angle_ - from_axis(v), right = 0.5 * std::numbers::pi;
    const double distance = v.norm() * std::sin(std::clamp(inside, -right, right));
    return allows_ ? distance : -distance;
  }

 private:
  double from_axis(const Vec3& v) const { return cone_angle({v.x(), v.y(), v.z()}, {axis_.x(), axis_.y(), axis_.z()}); }
  /// The corners decide, since the cone is convex.
  bool holds_box(const Vec3& centre, const Vec3& half, double slack) const {
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner =
          centre + Vec3(k & 1 ? half[0] : -half[0], k & 2 ? half[1] : -half[1], k & 4 ? half[2] : -half[2]);
      if (!(std::sin(angle_) * corner.dot(axis_) - std::cos(angle_) * corner.cross(axis_).norm() >= slack))
        return false;
    }
    return true;
  }

  /// Whether a plane separates the cone from the box: that which the cone touches nearest to the centre.
  bool misses_box(const Vec3& centre, const Vec3& half, double slack) const {
    const double outside = from_axis(centre) - angle_;
    if (!(outside > 0.0)) return false;
    Vec3 normal = centre.normalized();
    if (outside < 0.5 * std::numbers::pi) {
      const Vec3 across = (centre - centre.dot(axis_) * axis_).normalized();
      normal = std::cos(angle_) * across - std::sin(angle_) * axis_;
    }
    return normal.dot(centre) - normal.cwiseAbs().dot(half) >= slack;
  }

  bool allows_;
  Vec3 axis_;
  double angle_;
};

}  // namespace ninedof
