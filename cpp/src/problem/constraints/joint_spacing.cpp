/// joint_spacing: distance of every two of the six joints of a body; of "radius": of the largest distance of a joint of
/// that body from z. Declared in problem/constraints/table.hpp.

#include "problem/constraints/constraint.hpp"

namespace ninedof {
namespace {

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

std::unique_ptr<Constraint> make_joint_spacing(const Limit& limit, int, Purpose) {
  return std::make_unique<JointSpacing>(limit);
}

}  // namespace ninedof
