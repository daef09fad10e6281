#pragma once
/// Forces and rates of the legs of a machine at a pose, with their slopes.

#include "limits/leg_duty.hpp"

namespace ninedof {

/// Duals by every point of the pose.
class DutyDuals : public DualLook<point_count, false> {
 public:
  explicit DutyDuals(const PointLook& look);
  const Duty& duty() const { return look_.duty(); }

 private:
  const PointLook& look_;
};

/// A derivative by the points and by a turn of the platform beyond theirs.
struct DutySlope {
  DutyDuals::Number points = 0.0;
  Vec3 turn = Vec3::Zero();
};

class DutyAtPose {
 public:
  explicit DutyAtPose(const PointLook& look);

  /// The greatest modulus over the loads; infinite where one is not balanced. Keeps that load for `force_slope`.
  double force(int leg);
  DutySlope force_slope(int leg) const;
  /// The greatest rate. Keeps its direction for `rate_slope`.
  double rate(int leg);
  DutySlope rate_slope(int leg) const;

 private:
  bool settles(int leg) const { return leg >= 3 && duty_.motion.internal == InternalMotion::least; }
  Vec3 arm(int point) const;
  double scale(Eigen::Index column) const { return column < 3 ? length_ : 1.0; }

  const PointLook& look_;
  const Duty& duty_;
  double length_ = 0.0;  ///< of columns of turns in h
  std::array<Wrench<double>, 9> unit_;
  Mat9 h_;
  Vec9 forces_ = Vec9::Zero();
  Vec3 a_ = Vec3::Zero(), b_ = Vec3::Zero();
  Eigen::Matrix<double, 6, 3> k_;
  Eigen::Matrix<double, 3, 6> settled_;  ///< sdot for each unit twist
};

}  // namespace ninedof
