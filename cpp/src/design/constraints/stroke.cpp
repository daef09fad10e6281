/// stroke: longest less shortest length of each leg over the poses looked at. stroke_ratio: longest over shortest.
/// Declared in design/constraints/table.hpp.

#include "design/constraints/spread.hpp"

namespace ninedof {
namespace {

class Stroke : public Spread {
 public:
  Stroke(const Limit& limit, int poses, Purpose purpose)
      : Spread(limit, limit.name == "stroke_ratio" ? Measure::ratio : Measure::difference, 9, std::max(poses, 1),
               purpose) {}

 private:
  LegExtreme leg(const DesignState& v, int group, int k) const override { return {v.first_pose + k, group}; }
  LegExtreme longest(const DesignState& v, int group) const override { return {v.longest_of[at_index(group)], group}; }
  LegExtreme shortest(const DesignState& v, int group) const override {
    return {v.shortest_of[at_index(group)], group};
  }
};

}  // namespace

std::unique_ptr<Constraint> make_stroke(const Limit& limit, int poses, Purpose purpose) {
  return std::make_unique<Stroke>(limit, poses, purpose);
}

}  // namespace ninedof
