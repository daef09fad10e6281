#include "optimize/region/exchange.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "math/numbers.hpp"
#include "optimize/polish/active_set.hpp"
#include "optimize/verdict.hpp"

namespace ninedof {
namespace {

constexpr double passed = 2e-8;       // what may be passed between the poses: below what is promised, 1e-7
constexpr double one_place = 1e-9;    // of the region: nearer poses are one
constexpr double follows_known = 1e-2;  // in coordinates of the solver
constexpr double shrinks = 0.5;         // what is passed, from round to round where poses follow well
constexpr double last_step = 1e-4;      // in coordinates of the solver
constexpr double no_better = 2e-6;      // relative gain that is not worth the last rounds
constexpr int most_exact = 3;  // solutions without Newton's method, each from the last one, whose slack is too large
constexpr double may_be_left = 5e-8;  // to gain after them, without the slack: half of most_gain
constexpr int last_exact = 8;         // of them; then what is left is said
constexpr int most_drops = 20;        // rounds: then none leaves and joins again for ever
constexpr double replaces = 0.02;  // of the region: a later pose as near as this
constexpr int first_comparison = 3;  // round from which a design is compared with the best known

}  // namespace

void conclude(Result& result, bool settled, int rounds, const Candidate& best, double gain) {
  std::array<char, 200> text{};
  result.status = Status::stopped;
  if (!settled) {
    std::snprintf(
        text.data(), text.size(),
        "after %d rounds the design is still worse between the poses than at them: the optimum may be up to %.1e "
        "worse",
        rounds, gain);
  } else if (best.stationary() && gain > most_gain) {
    std::snprintf(text.data(), text.size(),
                  "no limit is passed in the region, but %.1e may be left to gain near this design", gain);
  } else if (!best.stationary()) {
    std::snprintf(text.data(), text.size(),
                  "no limit is passed in the region, but the test of stationarity leaves %.1e: a slightly better "
                  "design may exist",
                  best.optimality_residual);
  } else {
    std::snprintf(text.data(), text.size(),
                  "feasible and stationary by our own checks; near this design at most %.1e is left to gain", gain);
    result.status = Status::optimal;
  }
  result.reason = text.data();
}

double gain_of(const Settled& found) {
  double out = found.look.gain + found.slack;
  for (const auto& [name, by] : found.look.passed)
    if (const auto price = found.best.prices.find(name); price != found.best.prices.end()) out += price->second * by;
  return out;
}

PreparedProblem Exchange::prepared(const Imposed& imposed) const {
  const Problem there = posed(problem_, poses_of(problem_, region_, imposed));
  return {there, size_limits(there).back()};
}

Candidate Exchange::solved(const Following& following, const Eigen::VectorXd& x, bool exactly, Imposed& imposed) {
  PreparedProblem p = prepared(imposed);
  const auto first = p.objective_poses - static_cast<int>(imposed.at.size());
  Following moving;
  for (const auto& [k, pose] : following)
    if (p.follow(first + static_cast<int>(k), pose)) moving.emplace_back(k, pose);
  const auto run = [&](const Eigen::VectorXd& from, RunSettings how) {
    how.max_evaluations = settings_.max_evaluations;
    LocalRun out = run_from_start(p, p.coordinates.coordinates(from), Formulation::minimax, how, control_.stop);
    evaluations_ += out.evaluations;
    return std::move(out.end);
  };
  // Newton's method is content with values that are equal to 1e-6 only.
  constexpr RunSettings without_newton{.restarts = 0, .polish = false};
  Candidate out = run(x, exactly ? without_newton : RunSettings{.restarts = 1});
  if (exactly && !(out.feasible() && out.stationary()) && !control_.stop.stop_requested()) {
    out = run(x, {.restarts = 1});
    if (out.feasible() && !control_.stop.stop_requested()) out = run(out.variables, without_newton);
  }
  for (const auto& [k, pose] : moving) imposed.at[k] = pose->at_design(out.variables);
  return out;
}

double Exchange::slack(const Settled& of) const {
  const PreparedProblem p = prepared(of.imposed);
  return least_slack(p, p.coordinates.coordinates(of.best.variables));
}

Candidate Exchange::at_imposed(const Imposed& imposed, const Eigen::VectorXd& x) const {
  const PreparedProblem p = prepared(imposed);
  return candidate_at(p, p.coordinates.coordinates(x));
}

Imposed Exchange::holding(const Imposed& imposed, const Eigen::VectorXd& x) const {
  const PreparedProblem p = prepared(imposed);
  DesignEvaluation design;
  const Eigen::VectorXd y = p.with_auxiliary(p.coordinates.coordinates(x));
  design.state.length_joint = p.pieces(y).front();
  const ActiveSet active = evaluate_active(p, y, Contact::exact, design);
  const ActiveSet support = stationarity(p, design, active).support;
  std::set<int> poses;
  for (const RowLevel& u : p.row_levels)  // the worst, for the objective to the last digit
    if (design.objective_rows[u.row] == design.levels[u.level]) poses.insert(p.pose_of(u.row));
  for (const int k : support.row_levels) poses.insert(p.pose_of(p.row_levels[at_index(k)].row));
  for (const int k : support.margins)
    for (const int pose : poses_of_margin(p, design.state, k)) poses.insert(p.objective_pose(pose));
  const auto first = static_cast<int>(p.problem.objective.poses.size() - imposed.at.size());
  Imposed out{imposed.nodes, {}};
  for (const int pose : poses)
    if (pose >= first) out.at.push_back(imposed.at[at_index(pose - first)]);
  return out;
}

Look Exchange::look(const Settled& of, long samples, const Control& control) const {
  const auto seed = settings_.seed + static_cast<std::uint64_t>(rounds_);
  return look_over(problem_, region_, of.imposed, of.best.variables,
                   {.samples = samples, .seed = seed, .threads = settings_.threads}, control);
}

bool Exchange::hopeless(const Settled& here, const Settled* known) const {
  if (known == nullptr || !known->settled) return false;
  if (here.best.objective > known->best.objective * (1.0 - no_better)) return true;
  if (here.rounds < first_comparison) return false;
  return distance(here.best.variables, known->best.variables) < follows_known;
}

double Exchange::distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  const Coordinates c(problem_, size_limits(problem_).back());
  return (c.coordinates(a) - c.coordinates(b)).norm();
}

void Exchange::tell(const Settled& here, const Imposed& at) {
  clock_.begin();
  if (!settings_.phase) return;
  const std::size_t poses = at.nodes.size() + at.at.size();
  std::string text = "round " + std::to_string(rounds_) + ", at " + std::to_string(poses) + " poses";
  if (const double excess = here.look.excess; here.rounds > 1 && excess > passed)
    text += so_far(here.best.objective, excess, here.rounds - 1, passed, clock_);
  settings_.phase(text);
}

void Exchange::drop(const Eigen::VectorXd& x, std::size_t first, std::size_t last, Imposed& imposed) const {
  const Imposed few = holding(imposed, x);
  if (!at_imposed(few, x).stationary()) return;
  std::vector<Vec6> kept;
  for (std::size_t k = 0; k < imposed.at.size(); ++k) {
    const Vec6& at = imposed.at[k];
    const bool replaced = std::any_of(imposed.at.begin() + static_cast<std::ptrdiff_t>(k) + 1, imposed.at.end(),
                                      [&](const Vec6& other) { return distance_in(region_, at, other) <= replaces; });
    if (k < first || k >= last || !replaced || std::ranges::find(few.at, at) != few.at.end()) kept.push_back(at);
  }
  imposed.at = std::move(kept);
}

Exchange::Following Exchange::join(const Eigen::VectorXd& x, const std::vector<Look::Worst>& worst, bool moving,
                                   Imposed& imposed) const {
  Following out;
  std::optional<PoseFollower> follower;
  if (moving && !worst.empty()) follower.emplace(problem_, region_, x);
  for (const Look::Worst& one : worst) {
    const auto near = [&](const Vec6& other) { return distance_in(region_, one.at, other) <= one_place; };
    if (std::ranges::any_of(imposed.at, near)) continue;
    if (auto pose = follower ? follower->following(one) : nullptr) out.emplace_back(imposed.at.size(), std::move(pose));
    imposed.at.push_back(one.at);
  }
  return out;
}

Settled Exchange::follow(const Imposed& first, const Eigen::VectorXd& start, const Settled* known) {
  Settled out;
  Imposed imposed = first;
  std::size_t known_before = first.at.size();  // poses that did not join in the last round
  Eigen::VectorXd x = start;
  int exact = 0;  // rounds without Newton's method
  Following moving;  // poses that joined in the last round
  double excess = infinity;  // of the last look
  while (out.rounds < most_exchanges && !control_.stop.stop_requested()) {
    ++out.rounds;
    ++rounds_;
    tell(out, imposed);
    Candidate next = solved(moving, x, exact > 0, imposed);
    if (control_.stop.stop_requested()) {
      if (out.rounds == 1) out.rounds = 0;  // there is no design yet
      break;
    }
    out.best = std::move(next);
    out.imposed = imposed;
    out.look = {};
    out.slack = 0.0;
    if (!out.best.feasible()) break;
    // With poses that moved the error of the design is about the square of this step.
    const bool still = moving.empty() || distance(out.best.variables, x) <= last_step;
    x = out.best.variables;
    if (hopeless(out, known)) break;
    const auto holds = [&] {  // little of a dear limit is much
      return out.look.excess <= passed && gain_of(out) <= (exact < most_exact ? passed : may_be_left);
    };
    try {
      out.look = look(out, quick_samples, control_);
      if (still && holds()) out.look = look(out, dense_samples, control_);
    } catch (const Stopped&) {
      out.look = {};
      break;
    }
    if (still && holds()) {
      out.slack = slack(out);
      const bool stands = moving.empty() || at_imposed(imposed, x).stationary();  // where the poses stay too
      const bool near = out.slack <= passed || (exact >= most_exact && gain_of(out) <= most_gain);
      out.settled = (stands && near) || exact >= last_exact;
      if (out.settled) break;
    }
    exact += exact > 0 || (still && out.look.excess <= passed);
    if (out.rounds <= most_drops) drop(x, first.at.size(), known_before, imposed);
    known_before = imposed.at.size();
    // Poses that follow may carry away what excludes the design where they joined, so that two designs alternate: then
    // poses stay where they are.
    moving = join(x, out.look.worst, exact == 0 && out.look.excess <= shrinks * excess, imposed);
    excess = out.look.excess;
  }
  return out;
}

}  // namespace ninedof
