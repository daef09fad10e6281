#pragma once
/// Forces and rates of the legs of a machine at a pose, with their slopes.

#include <Eigen/LU>
#include <optional>
#include <vector>

#include "limits/leg_duty.hpp"
#include "limits/pose_row.hpp"

namespace ninedof {

/// The nine equations of H by blocks: O hangs on the internal legs alone, so that the platform has six equations of its
/// own for the external and the upper ones. A tenth of the time of nine equations, which sort out singular poses.
class ByBlocks {
 public:
  explicit ByBlocks(const Mat9& h);
  bool regular() const { return regular_; }
  /// f with H^T f = wanted.
  Vec9 forces(const Vec9& wanted) const;
  /// The motion t with H t = e_leg.
  Vec9 motion(int leg) const;

 private:
  Eigen::PartialPivLU<Mat6> platform_;
  Mat3 upper_;
  Eigen::PartialPivLU<Mat3> lower_;
  bool regular_;
};

class DutyAtPose {
 public:
  explicit DutyAtPose(const PointLook& look);

  /// The greatest modulus over the loads; infinite where one is not balanced. Keeps that load for its slope.
  double force(int leg);
  /// Adds `by` times the slopes of the last force.
  void add_force_slope(int leg, double by, PointSlopes& out) const;
  /// The greatest rate. Keeps its direction for its slope.
  double rate(int leg);
  void add_rate_slope(int leg, double by, PointSlopes& out) const;

 private:
  bool settles(int leg) const { return leg >= 3 && duty_.motion.internal == InternalMotion::least; }
  Vec3 arm(int point) const { return look_.here().at[at_index(point)] - look_.here().at[point_p]; }
  double scale(Eigen::Index column) const { return column < 3 ? length_ : 1.0; }
  void balance();
  void settle();
  Vec3 velocity(int point, const Vec9& motion) const;
  void add_power(int leg, double force, bool weighs, const Vec9& motion, PointSlopes& out) const;

  const PointLook& look_;
  const Duty& duty_;
  double length_ = 0.0;  ///< of columns of turns in h
  std::array<Wrench<double>, 9> unit_;
  Mat9 h_;
  std::optional<ByBlocks> blocks_;  ///< once a force is asked for
  std::vector<Vec9> forces_;        ///< under each load
  Vec9 ruling_ = Vec9::Zero();
  Vec3 a_ = Vec3::Zero(), b_ = Vec3::Zero();
  Eigen::Matrix<double, 6, 3> k_;
  std::optional<Eigen::Matrix<double, 3, 6>> settled_;  ///< sdot for each unit twist
};

}  // namespace ninedof
