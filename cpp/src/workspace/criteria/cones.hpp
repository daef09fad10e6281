#pragma once
/// Angles between the legs at a body and their axes.

#include <array>

#include "ninedof/robot/points.hpp"
#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

/// The six legs at the base or at the platform and the axes of their joints.
class Cones {
 public:
  /// `home` and `rotation` give the axes where the limit has none.
  Cones(const ConeLimit& limit, bool platform, const Points& home, const Mat3& rotation);

  /// The limit less each angle, radians: l1 l2 l3 and the body's internal legs.
  std::array<double, 6> margins(const Points& at, const Mat3& rotation) const;

  bool of_platform() const { return platform_; }
  double angle() const { return angle_; }
  /// In the body's frame.
  const Vec3& axis(int k) const { return axis_[at_index(k)]; }

 private:
  /// From the joint, in the body's frame.
  std::array<Vec3, 6> directions(const Points& at, const Mat3& rotation) const;

  double angle_;
  bool platform_;
  std::array<Vec3, 6> axis_;
};

}  // namespace ninedof
