/// zs_fraction: height of the internal point at the neutral configuration, as a fraction of the platform's.
/// Declared in problem/constraints/table.hpp.

#include "problem/constraints/constraint.hpp"

namespace ninedof {
namespace {

class ZsFraction : public Constraint {
 public:
  using Constraint::Constraint;

 private:
  int items(Side) const override { return 1; }
  double value(const DesignState& v, Side, int) const override { return v.blueprint.zs / v.blueprint.zp; }
  void add_value_gradient(const DesignState& v, Side, int, double scale, Row out) const override {
    const double zp = v.blueprint.zp;
    v.add_zs(scale / zp, out);
    v.add_zp(-scale * v.blueprint.zs / (zp * zp), out);
  }
};

}  // namespace

std::unique_ptr<Constraint> make_zs_fraction(const Limit& limit, int, Purpose) {
  return std::make_unique<ZsFraction>(limit);
}

}  // namespace ninedof
