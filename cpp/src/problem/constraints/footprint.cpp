/// footprint: largest distance of a base joint from z. Declared in problem/constraints/table.hpp.

#include "problem/constraints/constraint.hpp"

namespace ninedof {
namespace {

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

}  // namespace

std::unique_ptr<Constraint> make_footprint(const Limit& limit, int, Purpose) {
  return std::make_unique<Footprint>(limit);
}

}  // namespace ninedof
