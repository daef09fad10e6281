/// Where the joints lie on their plates, each in its body's frame.
/// radius_ratio: largest distance of a base joint from z over the same of the platform. footprint: the former alone.
/// joint_height: distance of joints from z = 0. joint_spacing: distance of every two of the six joints of a body; of
/// "radius": of the largest distance of a joint of that body from z. Declared in design/constraints/table.hpp.

#include "design/constraints/constraint.hpp"

namespace ninedof {
namespace {

class RadiusRatio : public Constraint {
 public:
  using Constraint::Constraint;

 private:
  // At most: every base joint against the widest of the platform. At least: the widest of the base against every other.
  int items(Side) const override { return 6; }
  static std::pair<int, int> joints(const DesignState& v, Side side, int item) {
    if (side == Side::high) return {item, widest_joint(v, point_u)};
    return {widest_joint(v, 0), point_u + item};
  }
  double value(const DesignState& v, Side side, int item) const override {
    const auto [base, platform] = joints(v, side, item);
    return joint_radius(v, base) / joint_radius(v, platform);
  }
  void add_value_gradient(const DesignState& v, Side side, int item, double scale, Row out) const override {
    const auto [base, platform] = joints(v, side, item);
    const double above = joint_radius(v, base), below = joint_radius(v, platform);
    if (!(below > 0.0)) return;
    add_joint_radius(v, base, scale / below, out);
    add_joint_radius(v, platform, -scale * above / (below * below), out);
  }
};

class Footprint : public Constraint {
 public:
  using Constraint::Constraint;

 private:
  // At most: every base joint. At least: the widest one.
  int items(Side side) const override { return side == Side::high ? 6 : 1; }
  static int joint(const DesignState& v, Side side, int item) { return side == Side::high ? item : widest_joint(v, 0); }
  double value(const DesignState& v, Side side, int item) const override {
    return joint_radius(v, joint(v, side, item));
  }
  void add_value_gradient(const DesignState& v, Side side, int item, double scale, Row out) const override {
    add_joint_radius(v, joint(v, side, item), scale, out);
  }
};

class JointHeight : public Constraint {
 public:
  using Constraint::Constraint;

 private:
  Form form() const override { return Form::linear; }
  // Above and below apart: |z| itself has a kink at zero.
  int items(Side) const override { return 24; }
  static double height(const DesignState& v, int item) {
    const double z = v.blueprint.joint[at_index(item % 12)].z();
    return item < 12 ? z : -z;
  }
  double value(const DesignState& v, Side, int item) const override { return height(v, item) / unit(v); }
  void add_value_gradient(const DesignState& v, Side, int item, double scale, Row out) const override {
    const double u = unit(v);
    v.add_joint(item % 12, Vec3(0.0, 0.0, (item < 12 ? scale : -scale) / u), out);
    add_unit_gradient(v, -scale * height(v, item) / (u * u), out);
  }
};

class JointSpacing : public Constraint {
 public:
  using Constraint::Constraint;

 private:
  static constexpr int pairs = 15;
  Form form() const override { return Form::linear; }
  int items(Side) const override { return 2 * pairs; }
  static std::pair<int, int> joints(int item) {
    int left = item % pairs, a = 0;
    for (; left >= 5 - a; ++a) left -= 5 - a;
    return {body(item) + a, body(item) + a + 1 + left};
  }
  static Vec3 between(const DesignState& v, int a, int b) {
    return v.blueprint.joint[at_index(a)] - v.blueprint.joint[at_index(b)];
  }
  static int body(int item) { return item < pairs ? 0 : point_u; }
  double value(const DesignState& v, Side, int item) const override {
    const auto [a, b] = joints(item);
    return between(v, a, b).norm() / unit(v, body(item));
  }
  void add_value_gradient(const DesignState& v, Side, int item, double scale, Row out) const override {
    const auto [a, b] = joints(item);
    const Vec3 d = between(v, a, b);
    const double distance = d.norm(), u = unit(v, body(item));
    if (distance > 0.0) {
      v.add_joint(a, scale / (distance * u) * d, out);
      v.add_joint(b, -scale / (distance * u) * d, out);
    }
    add_unit_gradient(v, -scale * distance / (u * u), out, body(item));
  }
};

}  // namespace

std::unique_ptr<Constraint> make_radius_ratio(const Limit& limit, int, Purpose) {
  return std::make_unique<RadiusRatio>(limit);
}

std::unique_ptr<Constraint> make_footprint(const Limit& limit, int, Purpose) {
  return std::make_unique<Footprint>(limit);
}

std::unique_ptr<Constraint> make_joint_height(const Limit& limit, int, Purpose) {
  return std::make_unique<JointHeight>(limit);
}

std::unique_ptr<Constraint> make_joint_spacing(const Limit& limit, int, Purpose) {
  return std::make_unique<JointSpacing>(limit);
}

}  // namespace ninedof
