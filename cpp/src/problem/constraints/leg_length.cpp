/// leg_length: every leg at every pose where the limit holds. external_length, upper_length, lower_length: the legs of
/// that kind. Declared in problem/constraints/table.hpp.

#include "problem/constraints/constraint.hpp"

namespace ninedof {
namespace {

class LegLength : public Constraint {
 public:
  LegLength(const Limit& limit, int poses) : Constraint(limit), poses_(std::max(poses, 1)) {
    if (limit.name == "leg_length") return;
    first_ = limit.name == "external_length" ? 0 : limit.name == "upper_length" ? 3 : 6;
    count_ = 3;
  }

 private:
  int items(Side) const override { return count_ * poses_; }
  LegExtreme leg(const DesignState& v, int item) const {
    return {first_pose(v) + item / count_, first_ + item % count_};
  }
  double value(const DesignState& v, Side, int item) const override { return v.length(leg(v, item)) / unit(v); }
  void add_value_gradient(const DesignState& v, Side, int item, double scale, Row out) const override {
    const LegExtreme l = leg(v, item);
    const double u = unit(v);
    v.add_leg(l.pose, l.leg, scale / u, out);
    add_unit_gradient(v, -scale * v.length(l) / (u * u), out);
  }

  int poses_, first_ = 0, count_ = 9;
};

}  // namespace

std::unique_ptr<Constraint> make_leg_length(const Limit& limit, int poses, Purpose) {
  return std::make_unique<LegLength>(limit, poses);
}

}  // namespace ninedof
