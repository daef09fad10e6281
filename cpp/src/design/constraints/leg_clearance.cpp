/// leg_clearance: distance of the axes of every two legs that share no joint, at every pose looked at. The internal legs all
/// end in O, so that one of every two is external. Legs share a joint if theirs coincide in every design the study allows;
/// in one design alone, that is a collision.
/// Declared in design/constraints/constraint.hpp.

#include <algorithm>

#include "design/constraints/constraint.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof {
namespace {

class LegClearance : public Constraint {
 public:
  LegClearance(const Limit& limit, int poses) : Constraint(limit), poses_(std::max(poses, 1)) {}

  /// Where two segments come nearest changes from design to design.
  bool analytic() const override { return false; }

  void learn(const std::vector<DesignState>& designs) override {
    for (int item = 0; item < leg_pairs; ++item) {
      const auto [a, b] = leg_pair(item);
      share_joint_[static_cast<std::size_t>(item)] =
          std::ranges::all_of(designs, [&](const DesignState& v) { return share_joint(v, a, b); });
    }
  }

 private:
  Form form() const override { return Form::linear; }
  int items(Side) const override { return leg_pairs * poses_; }
  static bool share_joint(const DesignState& v, int a, int b) {
    const auto same = [&](int i, int j) {
      return joints_coincide(v.blueprint.joint[static_cast<std::size_t>(i)],
                             v.blueprint.joint[static_cast<std::size_t>(j)]);
    };
    // Leg a is external, from the base to the platform; an upper leg starts on the platform, all others on the base.
    const LegEnds one = leg_ends(a), two = leg_ends(b);
    return same(two.from < point_u ? one.from : one.to, two.from) || (b < 3 && same(one.to, two.to));
  }
  Nearest look(const DesignState& v, int item) const {
    const auto [a, b] = leg_pair(item % leg_pairs);
    const Points& at = v.pose(v.first_pose + item / leg_pairs).at;
    const auto end = [&](int k) -> const Vec3& { return at[static_cast<std::size_t>(k)]; };
    return nearest(end(leg_ends(a).from), end(leg_ends(a).to), end(leg_ends(b).from), end(leg_ends(b).to));
  }
  double value(const DesignState& v, Side, int item) const override {
    if (share_joint_[static_cast<std::size_t>(item % leg_pairs)]) return exempt;
    return look(v, item).apart.norm() / unit(v);
  }
  void add_value_gradient(const DesignState& v, Side, int item, double scale, Row out) const override {
    if (share_joint_[static_cast<std::size_t>(item % leg_pairs)]) return;
    const auto [a, b] = leg_pair(item % leg_pairs);
    const Nearest n = look(v, item);
    const double distance = n.apart.norm(), u = unit(v);
    if (!(distance > 0.0)) return;
    const Vec3 g = scale / (distance * u) * n.apart;
    const int pose = v.first_pose + item / leg_pairs;
    v.add_point(pose, leg_ends(a).from, (1.0 - n.s) * g, out);
    v.add_point(pose, leg_ends(a).to, n.s * g, out);
    v.add_point(pose, leg_ends(b).from, -(1.0 - n.t) * g, out);
    v.add_point(pose, leg_ends(b).to, -n.t * g, out);
    add_unit_gradient(v, -scale * distance / (u * u), out);
  }

  static constexpr double exempt = 1e6;
  int poses_;
  std::array<bool, leg_pairs> share_joint_{};
};

}  // namespace

std::unique_ptr<Constraint> make_leg_clearance(const Limit& limit, int poses, Purpose) {
  return std::make_unique<LegClearance>(limit, poses);
}

}  // namespace ninedof
