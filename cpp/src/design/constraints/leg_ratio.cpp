/// leg_ratio: longest over shortest leg, of all legs at all poses looked at. Declared in design/constraints/table.hpp.

#include "design/constraints/spread.hpp"

namespace ninedof {
namespace {

class LegRatio : public Spread {
 public:
  LegRatio(const Limit& limit, int poses, Purpose purpose)
      : Spread(limit, Measure::ratio, 1, 9 * std::max(poses, 1), purpose) {}

 private:
  LegExtreme leg(const DesignState& v, int, int k) const override { return {v.first_pose + k / 9, k % 9}; }
  LegExtreme longest(const DesignState& v, int) const override { return v.longest; }
  LegExtreme shortest(const DesignState& v, int) const override { return v.shortest; }
};

}  // namespace

std::unique_ptr<Constraint> make_leg_ratio(const Limit& limit, int poses, Purpose purpose) {
  return std::make_unique<LegRatio>(limit, poses, purpose);
}

}  // namespace ninedof
