#include "optimize/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "math/splitmix.hpp"
#include "ninedof/math/parallel.hpp"

namespace ninedof {
namespace {

/// Share of the runs that must agree on the best objective for it to need no second look.
constexpr double agreement = 0.5;
constexpr double agreed = 1e-6;  // relative difference of objectives

/// Where starts are expensive: how many are followed to their end at least, and how far the others get.
constexpr int followed_at_least = 8;
constexpr int scouting_evaluations = 40, and_for_each_variable = 4;

/// A number in [0, 1) from three.
double hash(std::uint64_t seed, int a, int b) {
  return uniform_from(seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(a) * 0xD1B54A32D192ED03ULL +
                      static_cast<std::uint64_t>(b) * 0x8CB92BA72F3D8DD7ULL + 0x2545F4914F6CDD1DULL);
}

/// Allowed before not allowed, then the lower objective or violation.
bool better(const Candidate& a, const Candidate& b) {
  if (a.feasible() != b.feasible()) return a.feasible();
  return a.feasible() ? a.objective < b.objective : a.constraint_violation < b.constraint_violation;
}

/// Indices of the runs there are, best first.
std::vector<std::size_t> ranked(const Round& round) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < round.runs.size(); ++k)
    if (round.runs[k]) out.push_back(k);
  std::ranges::stable_sort(
      out, [&](std::size_t a, std::size_t b) { return better(round.runs[a]->end, round.runs[b]->end); });
  return out;
}

/// Where a start costs much: many poses, or singular values with kinks to be smoothed.
bool expensive(const Prepared& p) {
  return p.looked > 1 || p.kinked();
}

/// The same problem with s at its stated places: fewer variables, and near enough to tell good starts from bad ones.
Problem without_placing(Problem problem) {
  for (Pose& pose : problem.objective.poses) pose.best_internal = false;
  return problem;
}

/// Full variables of the problem from those of the one without placing.
Eigen::VectorXd with_places(const Prepared& p, const Eigen::VectorXd& x) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(p.problem.names().size()));
  out.head(x.size()) = x;
  return p.coordinates.coordinates(out);
}

/// Runs `count` starts, made when they are needed; each end gets its own place.
void run_all(const Prepared& p, int count, const std::function<Eigen::VectorXd(int)>& start, const Effort& effort,
             const Settings& s, const Control& control, Progress* progress, Round& round) {
  const std::size_t before = round.runs.size();
  round.runs.resize(before + static_cast<std::size_t>(count));
  parallel_for(count, 1, s.threads, [&](long first, long) {
    if (control.stop.stop_requested()) return;
    Run run = minimise(p, start(static_cast<int>(first)), Formulation::minimax, effort, control.stop);
    if (progress != nullptr) progress->finished(run.end);
    round.runs[before + static_cast<std::size_t>(first)] = std::make_unique<Run>(std::move(run));
  });
}

/// The same from a list.
void run_all(const Prepared& p, const std::vector<Eigen::VectorXd>& starts, const Effort& effort, const Settings& s,
             const Control& control, Round& round) {
  const auto at = [&](int k) { return starts[static_cast<std::size_t>(k)]; };
  run_all(p, static_cast<int>(starts.size()), at, effort, s, control, nullptr, round);
}

/// Follows the most promising starts only: which they are shows after a short run each.
std::vector<Eigen::VectorXd> scouted(const Prepared& p, double cap, const Settings& s, const Control& control,
                                     Progress& progress, Round& round) {
  const Prepared scout(without_placing(p.problem), cap);
  const int warm = static_cast<int>(s.warm.size());
  const auto start = [&](int k) {
    const Eigen::VectorXd x = p.coordinates.variables(start_at(p, s, warm + k));
    return scout.coordinates.coordinates(x.head(static_cast<Eigen::Index>(scout.problem.names().size())));
  };
  Round short_runs;
  run_all(scout, start_count(p, s) - warm, start,
          {scouting_evaluations + and_for_each_variable * scout.coordinates.size(), 0, false}, s, control, &progress,
          short_runs);
  // Warm starts need no scouting: they are followed as they are.
  std::vector<Eigen::VectorXd> out;
  for (int k = 0; k < warm; ++k) out.push_back(start_at(p, s, k));
  round.done = warm;
  const auto followed = std::max<std::size_t>(followed_at_least, short_runs.runs.size() / 8) + out.size();
  for (const std::size_t k : ranked(short_runs)) {
    round.evaluations += short_runs.runs[k]->evaluations;
    ++round.done;
    if (out.size() < followed) out.push_back(with_places(p, short_runs.runs[k]->end.variables));
  }
  round.stopped_early = round.done - static_cast<int>(out.size());
  return out;
}

/// Starts made of the best ends: some coordinates of one, the others of a fresh start. Local optima differ by a few choices (a
/// height up or down, a triple inside or outside), and a good design has most of them right.
std::vector<Eigen::VectorXd> recombined(const Prepared& p, const Settings& s, const Round& round, int count) {
  constexpr std::size_t parents = 8;
  std::vector<Eigen::VectorXd> bases;
  double last = 0.0;
  for (const std::size_t k : ranked(round)) {
    const Candidate& end = round.runs[k]->end;
    if (!end.feasible() || !end.regular()) break;
    if (!bases.empty() && end.objective <= last * (1.0 + agreed)) continue;
    last = end.objective;
    bases.push_back(p.coordinates.coordinates(end.variables));
    if (bases.size() == parents) break;
  }
  std::vector<Eigen::VectorXd> out;
  for (int k = 0; k < count && !bases.empty(); ++k) {
    // The better a design, the more often: 0, 0 1, 0 1 2, ...
    const auto which =
        static_cast<std::size_t>(hash(s.seed, k, -1) * hash(s.seed, k, -2) * static_cast<double>(bases.size()));
    Eigen::VectorXd y = bases[which];
    const Eigen::VectorXd fresh = p.coordinates.start(s.starts + k, s.seed);
    for (int v = 0; v < p.coordinates.size(); ++v)
      if (hash(s.seed, k, v) < 0.3) y[v] = fresh[v];
    out.push_back(std::move(y));
  }
  return out;
}

/// How many more starts: the more variables, the more ways to be half right.
int second_look(const Prepared& p, const Round& round) {
  const double share = std::min(1.0, p.coordinates.size() / 25.0);
  return std::max(1, static_cast<int>(share * static_cast<double>(round.runs.size())));
}

/// Whether enough runs ended at the best objective.
bool agree(const Round& round) {
  const std::vector<std::size_t> order = ranked(round);
  if (order.empty()) return true;
  const Candidate& best = round.runs[order.front()]->end;
  if (!best.feasible()) return true;  // recombining what is not allowed does not help
  const auto same = std::ranges::count_if(order, [&](std::size_t k) {
    const Candidate& c = round.runs[k]->end;
    return c.feasible() && c.objective <= best.objective * (1.0 + agreed);
  });
  return static_cast<double>(same) >= agreement * static_cast<double>(order.size());
}

}  // namespace

int start_count(const Prepared& p, const Settings& s) {
  return p.coordinates.size() == 0 ? 1 : s.starts + static_cast<int>(s.warm.size());
}

Eigen::VectorXd start_at(const Prepared& p, const Settings& s, int index) {
  const auto warm = static_cast<int>(s.warm.size());
  return index < warm && p.coordinates.size() > 0 ? p.coordinates.coordinates(s.warm[static_cast<std::size_t>(index)])
                                                  : p.coordinates.start(index - warm, s.seed);
}

Round run_round(const Prepared& p, double cap, const std::vector<Eigen::VectorXd>& further, const Settings& s,
                const Control& control, Progress& progress) {
  const Effort full{s.max_evaluations};
  Round round;
  if (expensive(p) && p.coordinates.size() > 0) {
    const std::vector<Eigen::VectorXd> chosen = scouted(p, cap, s, control, progress, round);
    run_all(p, chosen, full, s, control, round);
  } else {
    run_all(p, start_count(p, s), [&](int k) { return start_at(p, s, k); }, full, s, control, &progress, round);
    for (const auto& run : round.runs) round.done += run != nullptr;
  }
  round.from_starts = round.runs.size();
  std::vector<Eigen::VectorXd> more;
  for (const Eigen::VectorXd& x : further) more.push_back(p.coordinates.coordinates(x));
  run_all(p, more, full, s, control, round);
  if (p.coordinates.size() > 1 && s.starts > 1 && !agree(round))
    run_all(p, recombined(p, s, round, second_look(p, round)), full, s, control, round);
  for (const auto& run : round.runs)
    if (run) round.evaluations += run->evaluations;
  return round;
}

}  // namespace ninedof
