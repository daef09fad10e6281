/// Pairs of legs that may meet. Declared in ninedof/problem/problem.hpp.

#include "ninedof/problem/problem.hpp"
#include "problem/coordinates.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof {
namespace {

/// What holds in so many unrelated designs is taken to hold in every design.
constexpr int unrelated = 3;
constexpr double their_size = 100.0;

}  // namespace

std::array<bool, 21> exempt_pairs(const Problem& problem) {
  const DesignFamily& family = design_family(problem.family);
  const Coordinates within(problem, their_size * problem.unit());
  std::array<bool, leg_pairs> out;
  out.fill(true);
  for (int k = 0; k < unrelated; ++k) {
    const Eigen::VectorXd x = within.variables(within.start(7 * k + 1, 12345));
    Blueprint blueprint;
    family.blueprint({x.data(), family.variables().size()}, blueprint);
    for (int pair = 0; pair < leg_pairs; ++pair)
      out[at_index(pair)] = out[at_index(pair)] && share_joint(blueprint.joint, pair);
  }
  return out;
}

}  // namespace ninedof
