#pragma once
/// One design at every evaluated pose, and the derivatives of its points with respect to the solver's coordinates.

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "ninedof/conditioning/sensitivity.hpp"
#include "ninedof/domains/region.hpp"
#include "ninedof/robot/points.hpp"
#include "problem/coordinates.hpp"

namespace ninedof {

/// A row of derivatives with respect to the free coordinates.
using Row = Eigen::Ref<Eigen::RowVectorXd>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A pose of a region that moves with the design, as the worst one of a row does: the row then has the slopes and, near
/// the design where it starts, the curvature of the row's worst.
struct FollowingPose {
  Region region;
  Vec6 at;                    ///< at that design
  Eigen::VectorXd variables;  ///< of that design, those of the problem without poses
  Eigen::Matrix<double, 6, Eigen::Dynamic> by_variables;  ///< derivatives of `moved`

  /// The coordinates that lead to the pose of a design, before they are moved into the region.
  Vec6 moved(const Eigen::VectorXd& x) const { return at + by_variables * (x.head(variables.size()) - variables); }
  Vec6 at_design(const Eigen::VectorXd& x) const { return region.nearest(moved(x)); }
};

/// What fixes a pose: the displacement, and the variables that move s.
struct PoseSpec {
  Pose pose;
  double fraction = 1.0;                        ///< of the displacement from the neutral configuration
  std::array<int, 3> offset{-1, -1, -1};        ///< full variables that move s, or -1
  std::array<int, 3> coordinate{-1, -1, -1};    ///< free coordinates behind them
  std::optional<PoseSlopes> slopes{};  ///< where derivatives by the coordinates of the pose in a region are wanted
  std::shared_ptr<const FollowingPose> follows{};  ///< in place of the displacement
};

/// The neutral pose, the poses of the objective, and poses between them for singularity_free.
std::vector<PoseSpec> pose_specs(const Problem& problem, const Coordinates& coordinates);

/// One design at one pose.
struct PoseState : PosedPoints {
  Mat3 plate;          ///< the rotation of the platform's own frame; `rotation` is that of the tool
  Vec3 twist_axis;     ///< the platform turns about it as theta_z grows
  Vec3 p_by_zp, s_by_zp;
  double fraction;
  std::array<int, 3> coordinate;
  bool moves = false;  ///< whether `by_at` is known
  PoseSlopes by_at;  ///< derivatives by the coordinates in a region, at the fraction
  bool follows = false;  ///< the design; then `at_by_y` is known
  Eigen::Matrix<double, 6, Eigen::Dynamic> at_by_y;  ///< derivatives of the coordinates in a region by the free ones
};

/// A leg at a pose, the longest or shortest of some.
struct LegExtreme {
  int pose = 0, leg = 0;
};

class DesignState {
 public:
  /// `objective_poses`: how many of the specs, from the second on, belong to the objective.
  void set(const DesignFamily& family, const Problem& problem, const Coordinates& c, const std::vector<PoseSpec>& specs,
           int objective_poses, const Eigen::VectorXd& y);

  /// The same design at other poses, as many as before. Those of the neutral configuration must come first.
  void set_poses(const std::vector<PoseSpec>& specs);
  /// The same of one pose.
  void set_pose(int k, const PoseSpec& spec);

  Eigen::VectorXd x;  ///< full variables
  Blueprint blueprint;  ///< in the frames of the plates
  Tool tool;
  double unit = 1.0;  ///< Problem::unit; lengths are divided by it before a logarithm is taken
  double characteristic_length = 1.0;
  Eigen::RowVectorXd length_gradient;  ///< of the characteristic length; empty where it is a number
  /// Input: the platform joint whose distance is the characteristic length "platform_radius"; -1: the farthest.
  int length_joint = -1;
  std::vector<PoseState> poses;

  /// The evaluated poses: those of the objective, or the neutral one where there are none.
  int first_pose = 0, pose_count = 1;
  /// The free coordinates and, where a pose has slopes, six columns more: the coordinates of the pose in its region.
  Eigen::Index columns() const { return columns_ + (moves_ ? 6 : 0); }
  const PoseState& pose(int k) const { return poses[at_index(k)]; }

  /// Over the evaluated poses: of all legs, and the pose where each is longest and shortest.
  LegExtreme longest, shortest;
  std::array<int, 9> longest_of{}, shortest_of{};
  /// A joint from the origin of its body's frame, that of the platform being the tool's point; axes of the plates.
  Vec3 joint_arm(int joint) const {
    return joint < point_u ? blueprint.joint[at_index(joint)] : Vec3(blueprint.joint[at_index(joint)] - tool.position);
  }
  double joint_distance(int joint) const { return joint_arm(joint).norm(); }
  double length(const LegExtreme& l) const { return pose(l.pose).legs.length[l.leg]; }

  // Chain rule: each adds to the row `out` of a number the effect of its derivative `g` with respect to ...
  void add_joint(int joint, const Vec3& g, Row out) const;  ///< a joint in its plate's frame
  void add_zp(double g, Row out) const { add_jet(g, row_zp, out); }
  void add_zs(double g, Row out) const { add_jet(g, row_zs, out); }
  void add_point(int pose, int point, const Vec3& g, Row out) const;  ///< a point in the base frame
  void add_turn(int pose, const Vec3& g, Row out) const;              ///< a rotation of the platform, base axes
  void add_leg(int pose, int leg, double g, Row out) const;           ///< a leg length
  void add_length(double g, Row out) const;                           ///< the characteristic length
  void add(int pose, const PointGradient& g, Row out) const;          ///< all of them
  /// ... the family's variables and, in one more column, the characteristic length
  void add_variables(const Eigen::Ref<const Eigen::RowVectorXd>& g, Row out) const;

 private:
  void add_jet(double g, int row, Row out) const { out.head(jet_.cols()) += g * jet_.row(row); }
  void set_length(const StudyLength& length, int coordinate);
  void set_natural_length(const PoseState& home);
  double trial_length() const { return std::max(blueprint.zp, 1e-150); }
  void place(const PoseSpec& spec, PoseState& out) const;
  /// The derivatives of the coordinates of such a pose by the free ones.
  void follow(const FollowingPose& pose, PoseState& out) const;
  /// ... the coordinates of a pose in a region
  void add_at(const PoseState& v, const Vec6& g, Row out) const {
    if (v.follows) out.head(v.at_by_y.cols()).noalias() += g.transpose() * v.at_by_y;
    else out.segment<6>(columns_) += g.transpose();
  }
  void set_extremes();

  Mat3 tool_axes_ = Mat3::Identity();
  Vec3 tool_arm_ = Vec3::Zero(), tool_arm_by_theta_z_ = Vec3::Zero();  ///< from the plate's origin at home, base axes
  Rows jet_;  ///< Blueprint::gradient by free coordinate, up to the last that the family depends on
  Eigen::Index columns_ = 0;  ///< the free coordinates; those of internal points, of which there may be many, are last
  bool moves_ = false;  ///< whether a pose has slopes
  Eigen::VectorXd slopes_;
  std::vector<int> free_;  ///< full variable behind each free coordinate
  std::vector<int> column_;  ///< free coordinate behind each of the family's variables, or -1
};

}  // namespace ninedof
