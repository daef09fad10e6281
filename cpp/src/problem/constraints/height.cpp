/// height: zp, the height of the platform frame over the base frame at the neutral configuration.
/// Declared in problem/constraints/table.hpp.

#include "problem/constraints/constraint.hpp"

namespace ninedof {
namespace {

class Height : public Constraint {
 public:
  using Constraint::Constraint;

 private:
  int items(Side) const override { return 1; }
  double value(const DesignState& v, Side, int) const override { return v.blueprint.zp; }
  void add_value_gradient(const DesignState& v, Side, int, double scale, Row out) const override {
    v.add_zp(scale, out);
  }
};

}  // namespace

std::unique_ptr<Constraint> make_height(const Limit& limit, int, Purpose) {
  return std::make_unique<Height>(limit);
}

}  // namespace ninedof
