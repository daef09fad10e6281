#include "optimize/region/placed_poses.hpp"

#include <algorithm>

#include "math/sort_by.hpp"
#include "ninedof/robot/legs.hpp"
#include "problem/full_variables.hpp"

namespace ninedof {
namespace {

constexpr double same_place = 1e-6;      // of the region: nearer poses are one
constexpr double join_apart = 0.2;       // of the region: nearer poses do not join together
constexpr std::size_t most_joined_placed = 16;  // in a round
constexpr double decides = 1e-4;         // a pose where O leaves less to spare decides
constexpr double neighbours = 0.05;      // of the region: of nearer poses only the worst decides
constexpr double extreme = 1e-5;         // relative: a leg that is nearly as long as at any pose

}  // namespace

PlacedPoses::PlacedPoses(const Problem& problem, const Region& region)
    : problem_(problem),
      region_(region),
      alone_(without_poses(problem)),
      zp_(design_family(problem.family).index("zp")),
      listed_(problem.objective.poses.size()) {
  region_.shifted = false;
}

Problem PlacedPoses::posed(const std::vector<Placed>& ruling) const {
  std::vector<Pose> poses;
  for (const Placed& placed : ruling) {
    poses.push_back(region_.pose(placed.at));
    poses.back().best_internal = true;
  }
  return ninedof::posed(problem_, poses);
}

Pose PlacedPoses::pose(const Placed& placed, const PlacedDesign& design) const {
  Pose out = region_.pose(placed.at);
  out.internal = (out.in_zp ? 1.0 : zp(design)) * placed.shift;
  return out;
}

Vec3 PlacedPoses::shifted(const Vec6& at, const PlacedDesign& design) const {
  return shifted_with(region_.pose(at), zp(design));
}

Eigen::VectorXd PlacedPoses::variables(const PlacedState& state) const {
  return with_shifts(posed(state.ruling), state.design.variables, state.design.shifts);
}

PlacedState PlacedPoses::state(const Eigen::VectorXd& full, const std::vector<Placed>& ruling,
                               double log_objective) const {
  PlacedState out;
  const Problem there = posed(ruling);
  out.design.variables = own_variables(problem_, full);
  out.design.log_objective = log_objective;
  out.ruling = ruling;
  for (std::size_t k = 0; k < listed_ + ruling.size(); ++k) {
    const std::array<int, 3> offset = offset_variables(there, k);
    Vec3 shift = Vec3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (offset[axis] >= 0) shift[static_cast<Eigen::Index>(axis)] = full[offset[axis]];
    out.design.shifts.push_back(shift);
    if (k >= listed_) out.ruling[k - listed_].shift = shift;
  }
  return out;
}

std::vector<Vec9> PlacedPoses::lengths(const PlacedState& state) const {
  const Problem there = posed(state.ruling);
  const Eigen::VectorXd x = variables(state);
  const Geometry g = geometry(there, x);
  std::vector<Vec9> out;
  const std::vector<Configuration> all = configurations(there, x);
  for (std::size_t k = 1; k < all.size(); ++k) out.push_back(leg_lengths(g, all[k]));
  return out;
}

PlacedLook PlacedPoses::look(const PlacedState& state, const RegionSettings& settings, double passed,
                             const Control& control) const {
  const PlacementGoal goal{state.design.log_objective, leg_ranges(alone_, zp(state.design), lengths(state))};
  const PlacedWorst found =
      search_region_placed(alone_, region_, state.design.variables, goal, state.ruling, settings, control);
  PlacedLook out;
  out.excess = found.at_known;
  out.poses = found.poses;
  out.worst = *std::ranges::max_element(found.ends, {}, &PlacedEnd::log_index);
  for (const PlacedEnd& end : found.ends) {
    if (end.excess > passed) out.worse.push_back(end);
    if (!(end.margin < out.margin)) continue;
    out.margin = end.margin;
    out.limit = end.limit;
  }
  sort_by(out.worse, [](const PlacedEnd& end) { return -end.excess; });
  return out;
}

std::vector<Placed> PlacedPoses::kept(const PlacedState& state, const PlacedLook& look, double idle) const {
  const std::vector<Vec9> all = lengths(state);
  Vec9 longest = all.front(), shortest = all.front();
  for (const Vec9& some : all) {
    longest = longest.cwiseMax(some);
    shortest = shortest.cwiseMin(some);
  }
  std::vector<Placed> out;
  for (std::size_t k = 0; k < state.ruling.size(); ++k) {
    const Vec9& here = all[listed_ + k];
    const bool ends = (here.array() >= longest.array() * (1.0 - extreme)).any() ||
                      (here.array() <= shortest.array() * (1.0 + extreme)).any();
    if (k == 0 || ends || look.excess[k] > -idle) out.push_back(state.ruling[k]);
  }
  return out;
}

std::vector<Placed> PlacedPoses::deciding(const PlacedState& state, const PlacedLook& look) const {
  std::vector<Placed> chosen = kept(state, look, decides), out;
  const auto less_excess = [&](const Placed& placed) {
    const auto at = std::ranges::find(state.ruling, placed.at, &Placed::at);
    return -look.excess[static_cast<std::size_t>(at - state.ruling.begin())];
  };
  sort_by(chosen, less_excess);
  for (const Placed& placed : chosen)
    if (!beside(placed, out)) out.push_back(placed);
  return out;
}

bool PlacedPoses::beside(const Placed& placed, const std::vector<Placed>& others) const {
  return std::ranges::any_of(others,
                             [&](const Placed& o) { return distance_in(region_, placed.at, o.at) <= neighbours; });
}

std::vector<Placed> PlacedPoses::joined(std::vector<Placed> ruling, const PlacedLook& look) const {
  std::vector<Placed> fresh;
  for (const PlacedEnd& end : look.worse) {
    if (fresh.size() == most_joined_placed) break;
    const auto apart = [&](const std::vector<Placed>& from, double by) {
      return std::ranges::none_of(from,
                                  [&](const Placed& o) { return distance_in(region_, end.placed.at, o.at) <= by; });
    };
    if (apart(ruling, same_place) && apart(fresh, join_apart)) fresh.push_back(end.placed);
  }
  ruling.insert(ruling.end(), fresh.begin(), fresh.end());
  return ruling;
}

std::vector<Placed> PlacedPoses::replaced(const PlacedState& state, const PlacedLook& look) const {
  const std::vector<Placed> fresh = joined({}, look);
  std::vector<Placed> out;
  for (const Placed& placed : state.ruling)
    if (!beside(placed, fresh)) out.push_back(placed);
  out.insert(out.end(), fresh.begin(), fresh.end());
  return out;
}

bool PlacedPoses::nothing_new(const PlacedState& state, const PlacedLook& look) const {
  return std::ranges::all_of(look.worse, [&](const PlacedEnd& end) {
    return std::ranges::any_of(
        state.ruling, [&](const Placed& o) { return distance_in(region_, end.placed.at, o.at) <= same_place; });
  });
}

}  // namespace ninedof
