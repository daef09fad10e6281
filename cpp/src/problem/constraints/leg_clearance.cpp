/// leg_clearance: distance of the axes of every two legs that share no joint, at every pose where the limit holds. The
/// internal legs all end in O, so that one of every two is external. Legs share a joint if their joints coincide in
/// every design the study allows; joints that coincide in one design alone collide. Declared in
/// problem/constraints/table.hpp.

#include <algorithm>

#include "problem/constraints/constraint.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof {
namespace {

class LegClearance : public Constraint {
 public:
  LegClearance(const Limit& limit, int poses) : Constraint(limit), poses_(std::max(poses, 1)) {}

  /// Which points of two segments are nearest changes from design to design.
  bool analytic() const override { return false; }

  void learn(const std::vector<DesignState>& designs) override {
    for (int item = 0; item < leg_pairs; ++item) {
      share_joint_[at_index(item)] =
          std::ranges::all_of(designs, [&](const DesignState& v) { return share_joint(v.blueprint.joint, item); });
    }
  }

 private:
  Form form() const override { return Form::linear; }
  int items(Side) const override { return leg_pairs * poses_; }
  Nearest between_legs(const DesignState& v, int item) const {
    return nearest(v.pose(first_pose(v) + item / leg_pairs).at, item % leg_pairs);
  }
  double value(const DesignState& v, Side, int item) const override {
    if (share_joint_[at_index(item % leg_pairs)])
      return never_least * std::max(limit().low, v.length(v.longest) / unit(v));
    return between_legs(v, item).apart.norm() / unit(v);
  }
  void add_value_gradient(const DesignState& v, Side, int item, double scale, Row out) const override {
    if (share_joint_[at_index(item % leg_pairs)]) return;
    const auto [a, b] = leg_pair(item % leg_pairs);
    const Nearest n = between_legs(v, item);
    const double distance = n.apart.norm(), u = unit(v);
    if (!(distance > 0.0)) return;
    const Vec3 g = scale / (distance * u) * n.apart;
    const int pose = first_pose(v) + item / leg_pairs;
    v.add_point(pose, leg_ends(a).from, (1.0 - n.s) * g, out);
    v.add_point(pose, leg_ends(a).to, n.s * g, out);
    v.add_point(pose, leg_ends(b).from, -(1.0 - n.t) * g, out);
    v.add_point(pose, leg_ends(b).to, -n.t * g, out);
    add_unit_gradient(v, -scale * distance / (u * u), out);
  }

  static constexpr double never_least = 1e6;  ///< so many times the limit and the longest leg: in any unit
  int poses_;
  std::array<bool, leg_pairs> share_joint_{};
};

}  // namespace

std::unique_ptr<Constraint> make_leg_clearance(const Limit& limit, int poses, Purpose) {
  return std::make_unique<LegClearance>(limit, poses);
}

}  // namespace ninedof
