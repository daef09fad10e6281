/// radius_ratio: largest distance of a base joint from z over the same of the platform, each in its own frame.
/// Declared in problem/constraints/table.hpp.

#include "problem/constraints/constraint.hpp"

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

}  // namespace

std::unique_ptr<Constraint> make_radius_ratio(const Limit& limit, int, Purpose) {
  return std::make_unique<RadiusRatio>(limit);
}

}  // namespace ninedof
