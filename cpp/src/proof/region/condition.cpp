/// The worst condition number over all poses. Declared in ninedof/proof/machine.hpp.

#include "conditioning/forms/gram.hpp"
#include "ninedof/conditioning/locked_legs.hpp"
#include "ninedof/math/error.hpp"
#include "proof/region/worst.hpp"

namespace ninedof {
namespace over_region {
namespace {

class ConditionOverPoses final : public IndexOverPoses {
 public:
  ConditionOverPoses(const Domain& domain, int locked)
      : IndexOverPoses(domain), length_(domain.machine().characteristic_length), locked_(locked) {}

  /// With a leg locked it is that of doubles, with room for rounding.
  double at(const Geometry& g, const Box& point) const override {
    constexpr double room = 1e-9;
    if (locked_ >= 0) {
      const PosedPoints here = posed_points(g, domain().configuration(point));
      return LockedLegs(here.at, here.legs, length_).condition_number({locked_}) * (1.0 - room);
    }
    Moves unused;
    return forms::condition_attained(forms::gram(g, length_, domain().pose(point), unused));
  }
  bool bounded(const Box& box, double bound, Moves& moves) const override {
    const PoseOf<CurvedForm> pose = domain().pose<CurvedForm>(box);
    const AsBuilt& built = domain().built();
    if (locked_ >= 0) return forms::bounded(forms::split_gram(built, length_, pose, moves, locked_), bound);
    const AsBuilt drawn{built.nominal};
    const forms::SplitGramOf<CurvedForm> g = forms::split_gram(drawn, length_, pose, moves);
    return forms::bounded(g, bound, built.exact() ? forms::Looseness{} : forms::looseness(built, length_, pose, g));
  }

 private:
  double length_;
  int locked_;
};

}  // namespace
}  // namespace over_region

WorstOverPoses worst_condition(const PosedRobot& machine, const ProofSettings& settings, const PoseBoxes& from,
                               const Control& control) {
  using namespace over_region;
  const int locked = settings.locked;
  if (locked >= 0 && (locked < 3 || locked > 8))
    throw InvalidArgument("locked", std::to_string(locked), "an internal leg, 3 to 8, or -1");
  const Domain domain(machine);
  const ConditionOverPoses index(domain, locked);
  return worst(index, searched(index, settings.threads, control.stop), settings, from, control);
}

}  // namespace ninedof
