/// joint_height: distance of every joint from z = 0 of their body's frame. Declared in problem/constraints/table.hpp.

#include "problem/constraints/constraint.hpp"

namespace ninedof {
namespace {

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

}  // namespace

std::unique_ptr<Constraint> make_joint_height(const Limit& limit, int, Purpose) {
  return std::make_unique<JointHeight>(limit);
}

}  // namespace ninedof
