#include "ninedof/optimize/rule_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "optimize/rule/minimax_fit.hpp"
#include "optimize/rule/rule_samples.hpp"

namespace ninedof {
namespace {

constexpr int highest_degree = 6, most_rounds = 8;  // rounds of proofs, and of poses that join
constexpr std::size_t most_terms = 150;
constexpr double good = 1e-2;  // of the logarithm of the index: a rule so near the best O is not made finer
constexpr double gain = 2e-3;  // by which a higher degree has to be better
constexpr double caution = 0.1;  // of what was passed, is left too from then on
constexpr double first_smoothings[] = {5e-2, 1e-2}, last_smoothings[] = {3e-3, 1e-3};
constexpr double proof_seconds = 4.0;  // where bounds are met counts, not what is proved
constexpr double wide_gap = 20.0;      // one that is proved at once

using Say = std::function<void(const std::string&)>;

/// All powers up to a degree of the coordinates that move.
std::vector<Powers> powers_up_to(int most, const std::vector<std::size_t>& moving) {
  std::vector<Powers> out{Powers{}};
  std::vector<std::pair<Powers, std::size_t>> last{{Powers{}, 0}};  // with the first coordinate that may rise
  for (int total = 1; total <= most; ++total) {
    std::vector<std::pair<Powers, std::size_t>> next;
    for (const auto& [term, first] : last)
      for (std::size_t k = first; k < moving.size(); ++k) {
        next.emplace_back(term, k);
        ++next.back().first[moving[k]];
        out.push_back(next.back().first);
      }
    last = std::move(next);
  }
  return out;
}

std::vector<std::size_t> moving_coordinates(const RuleRows& rows, const std::vector<Placed>& places) {
  std::vector<std::size_t> out;
  const Vec6 first = rule_coordinates(rows, places.front().at);
  for (std::size_t k = 0; k < 6; ++k)
    if (std::ranges::any_of(places, [&, n = static_cast<Eigen::Index>(k)](const Placed& place) {
          return rule_coordinates(rows, place.at)[n] != first[n];
        }))
      out.push_back(k);
  return out;
}

/// The fit of the lowest degree that is good at the sampled poses.
MinimaxFit fitted(const RuleRows& rows, const Say& say) {
  const std::vector<Vec6> poses = first_rule_poses(rows.region());
  say("placing O at " + std::to_string(poses.size()) + " poses");
  const std::vector<Placed> places = rows.best(poses);
  const std::vector<std::size_t> moving = moving_coordinates(rows, places);
  std::optional<MinimaxFit> best;
  for (int order = 1; order <= highest_degree; ++order) {
    const std::vector<Powers> powers = powers_up_to(order, moving);
    if (best && (powers.size() > most_terms || powers.size() == best->term_count())) break;
    say("fitting a rule for O of degree " + std::to_string(order));
    MinimaxFit fit(rows, powers, places);
    for (const double smoothing : first_smoothings) fit.lower(smoothing);
    if (best && fit.worst() > best->worst() - gain) break;
    if (fit.worst() < 2.0 * good)
      for (const double smoothing : last_smoothings) fit.lower(smoothing);
    best.emplace(std::move(fit));
    if (best->worst() < good) break;
  }
  return std::move(*best);
}

/// What proofs of a rule have met.
struct Checked {
  double index = -infinity;   // its logarithm less that of the goal
  double passed = -infinity;  // the part of itself by which a limit is passed
  std::vector<Vec6> poses;    // where

  /// What is compared: limits come first.
  std::pair<bool, double> rank() const { return {passed > 0.0, std::max(index, RuleRows::weight * passed)}; }
};

Checked checked(const RuleTask& task, const PointRule& rule, int threads, const Control& control) {
  PosedRobot machine = task.machine;
  machine.rule = {rule};
  machine.tool = task.problem.tool;
  const ProofSettings how{.threads = threads, .seconds = proof_seconds, .gap = wide_gap};
  const LimitsOverPoses limits =
      limits_over_poses(machine, task.problem.limits, exempt_pairs(task.problem), 0.0, how, control);
  const WorstOverPoses condition = worst_condition(machine, how, {}, control);
  if (control.stop.stop_requested()) throw Stopped{};
  Checked out;
  for (const LimitOverPoses& limit : limits.limits) {
    if (limit.at.empty() || limit.answer == LimitOverPoses::Answer::proved) continue;
    const bool high = limit.side == Side::high;
    const double worst = high ? limit.value.lo : limit.value.hi;
    const double part = limit.limit == 0.0 ? worst : worst / limit.limit - 1.0;  // a determinant is itself the part
    out.passed = std::max(out.passed, high ? part : -part);
  }
  if (task.problem.objective.index == Index::condition_number)
    out.index = std::log(condition.extreme.low) - task.goal.log_index;
  const Region& region = machine.region.front();
  const double unit = region.unit(machine.neutral);
  for (const MetAt& met : limits.met) out.poses.push_back(region_coordinates(region, unit, met));
  if (condition.extreme.at.pose < 0) out.poses.push_back(region_coordinates(region, unit, condition.extreme.at));
  return out;
}

}  // namespace

PointRule fit_rule(const RuleTask& task, const RuleSettings& settings, const Control& control) {
  if (task.machine.region.empty() || !task.machine.rule.empty())
    throw InvalidArgument("machine", task.machine.region.empty() ? "one without a region" : "one with a rule",
                          "one with a region and without a rule");
  const auto say = [&](const std::string& words) {
    if (settings.phase) settings.phase(words);
  };
  const auto in_round = [](const char* words, int round) {
    return std::string(words) + ", round " + std::to_string(round) + " of at most " + std::to_string(most_rounds);
  };
  RuleRows rows(task, settings.threads, control);
  MinimaxFit fit = fitted(rows, say);
  std::optional<std::pair<std::pair<bool, double>, PointRule>> best;
  for (int round = 1;; ++round) {
    const PointRule rule = fit.rule();
    say(in_round("checking the rule for O", round));
    const Checked found = checked(task, rule, settings.threads, control);
    if (!best || found.rank() < best->first) best = {found.rank(), rule};
    if ((found.passed <= 0.0 && found.index <= fit.worst() + gain) || round == most_rounds) return best->second;
    // A goal out of reach would count for more than limits.
    if (found.passed > 0.0 && found.index > good) rows.goal = task.goal.log_index + found.index;
    say(in_round("mending the rule for O", round));
    rows.margin += caution * std::max(found.passed, 0.0);
    fit.join(found.poses);
    for (const double smoothing : last_smoothings) fit.lower(smoothing);
  }
}

}  // namespace ninedof
