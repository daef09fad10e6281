/// base_cone, platform_cone: angle between each leg, pointing away from its joint on that body, and an axis of the
/// body: a given one, or the direction of that leg at the neutral configuration. Declared in
/// problem/constraints/table.hpp.

#include "problem/constraints/constraint.hpp"
#include "robot/joint_cones.hpp"

namespace ninedof {
namespace {

class JointCone : public Constraint {
 public:
  JointCone(const Limit& limit, int poses)
      : Constraint(limit), poses_(std::max(poses, 1)), platform_(limit.name == "platform_cone") {}

 private:
  Form form() const override { return Form::linear; }
  int items(Side) const override { return legs_at_body * poses_; }
  bool axis_given() const { return !limit().axis.isZero(0.0); }

  int leg(int item) const { return leg_at(platform_, item % legs_at_body); }
  double sense(int item) const { return sense_at(platform_, item % legs_at_body); }

  Vec3 direction(const DesignState& v, int pose, int item) const {
    return sense(item) * v.pose(pose).legs.direction[at_index(leg(item))];
  }
  Mat3 frame(const DesignState& v, int pose) const {
    return platform_ ? v.pose(pose).rotation : Mat3(Mat3::Identity());
  }

  /// The axis at a pose, base frame.
  Vec3 axis(const DesignState& v, int pose, int item) const {
    if (axis_given()) return frame(v, pose) * limit().axis.normalized();
    return frame(v, pose) * (frame(v, 0).transpose() * direction(v, 0, item));
  }

  double value(const DesignState& v, Side, int item) const override {
    const int pose = first_pose(v) + item / legs_at_body;
    return cone_angle(direction(v, pose, item), axis(v, pose, item));
  }

  /// Adds scale * d(direction . g) with g fixed in the base frame.
  void add_direction(const DesignState& v, int pose, int item, const Vec3& g, double scale, Row out) const {
    const int k = leg(item);
    const double length = v.pose(pose).legs.length[k];
    if (!(length > 0.0)) return;
    const Vec3& e = v.pose(pose).legs.direction[at_index(k)];
    const Vec3 across = sense(item) * scale / length * (g - g.dot(e) * e);
    v.add_point(pose, leg_ends(k).to, across, out);
    v.add_point(pose, leg_ends(k).from, -across, out);
  }

  void add_value_gradient(const DesignState& v, Side, int item, double scale, Row out) const override {
    const int pose = first_pose(v) + item / legs_at_body;
    const Vec3 d = direction(v, pose, item), a = axis(v, pose, item);
    const double sine = d.cross(a).norm();
    if (!(sine > 1e-12)) return;  // on the axis, where the angle has no gradient
    const double by_cosine = -scale / sine;
    add_direction(v, pose, item, a, by_cosine, out);
    if (platform_) v.add_turn(pose, by_cosine * a.cross(d), out);
    if (axis_given()) return;
    // The axis moves with the neutral leg.
    const Vec3 back = frame(v, 0) * (frame(v, pose).transpose() * d);
    add_direction(v, 0, item, back, by_cosine, out);
    if (platform_) v.add_turn(0, by_cosine * back.cross(direction(v, 0, item)), out);
  }

  int poses_;
  bool platform_;
};

}  // namespace

std::unique_ptr<Constraint> make_joint_cone(const Limit& limit, int poses, Purpose) {
  return std::make_unique<JointCone>(limit, poses);
}

}  // namespace ninedof
