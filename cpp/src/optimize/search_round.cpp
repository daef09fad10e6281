#include "optimize/search_round.hpp"

#include <algorithm>
#include <functional>

#include "math/splitmix.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "ninedof/optimize/region_placement.hpp"
#include "optimize/region/posed.hpp"

namespace ninedof {
namespace {

/// More starts are run unless this share of the runs has the best objective.
constexpr double agreement = 0.5;
/// Another batch follows unless so many have, or more than that share.
constexpr int enough = 16;
constexpr double agreed = 1e-6;  // relative difference of objectives

/// Where starts are expensive: how many at least are run to their end, and the length of the short runs before.
constexpr int least_full_runs = 8;
constexpr int short_run_evaluations = 40, evaluations_per_variable = 4;

/// A pseudo-random number in [0, 1) from a seed and two indices.
double hash(std::uint64_t seed, int a, int b) {
  return uniform_from(seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(a) * 0xD1B54A32D192ED03ULL +
                      static_cast<std::uint64_t>(b) * 0x8CB92BA72F3D8DD7ULL + 0x2545F4914F6CDD1DULL);
}

/// Feasible before infeasible, then the lower objective or violation.
bool better(const Candidate& a, const Candidate& b) {
  if (a.feasible() != b.feasible()) return a.feasible();
  return a.feasible() ? a.objective < b.objective : a.constraint_violation < b.constraint_violation;
}

/// Indices of the runs that began, best first.
std::vector<std::size_t> ranked(const SearchRound& round) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < round.runs.size(); ++k)
    if (round.runs[k]) out.push_back(k);
  std::ranges::stable_sort(
      out, [&](std::size_t a, std::size_t b) { return better(round.runs[a]->end, round.runs[b]->end); });
  return out;
}

/// The same problem with s where stated: fewer variables, and close enough to tell good starts from bad ones.
Problem with_stated_internal_points(Problem problem) {
  for (Pose& pose : problem.objective.poses) pose.best_internal = false;
  return problem;
}

/// Whether the quick solver finds the optimum with O placed (see optimize_placed); with few poses SLSQP is as quick.
bool places_quickly(const PreparedProblem& p) {
  constexpr int few = 3;
  const auto& poses = p.problem.objective.poses;
  return p.problem.objective.aggregate == Aggregate::worst && p.problem.objective.index != Index::six_legged &&
         std::ranges::count_if(poses, optimizes_internal_point) > few;
}

/// Each start is moved to where the quick solver ends from its design with O shifted.
std::vector<Eigen::VectorXd> placed(const PreparedProblem& p, const std::vector<Eigen::VectorXd>& starts,
                                    const Settings& s, const Control& control) {
  const std::vector<Pose>& poses = p.problem.objective.poses;
  std::vector<PlacedDesign> given;
  for (const Eigen::VectorXd& y : starts) {
    PlacedDesign design{own_variables(p.problem, p.coordinates.variables(y)), {}};
    const double zp = design.variables[design_family(p.problem.family).index("zp")];
    for (const Pose& pose : poses)
      design.shifts.push_back(optimizes_internal_point(pose) ? shifted_with(pose, zp) : Vec3(Vec3::Zero()));
    given.push_back(std::move(design));
  }
  std::vector<Eigen::VectorXd> out;
  try {
    for (const PlacedDesign& end : optimize_placed(p.problem, given, {0, s.seed, s.threads}, control))
      out.push_back(p.coordinates.coordinates(with_shifts(p.problem, end.variables, end.shifts)));
  } catch (const Stopped&) {
    return starts;
  }
  return out;
}

/// Solver coordinates from the full variables of the problem with stated internal points; offsets are 0.
Eigen::VectorXd with_zero_offsets(const PreparedProblem& p, const Eigen::VectorXd& x) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(p.problem.names().size()));
  out.head(x.size()) = x;
  return p.coordinates.coordinates(out);
}

/// The starts of a batch in solver coordinates; the first one begins with the warm starts.
struct Batch {
  const PreparedProblem& p;
  const Settings& s;
  int number;

  int warm() const { return number == 0 ? static_cast<int>(s.warm.size()) : 0; }
  int count() const { return number == 0 ? start_count(p, s) : s.starts; }
  Eigen::VectorXd start(int index) const {
    return index < warm() && p.coordinates.size() > 0 ? p.coordinates.coordinates(s.warm[at_index(index)])
                                                      : p.coordinates.start(number * s.starts + index - warm(), s.seed);
  }
};

/// Appends the runs of `count` starts, in their order.
void run_all(const PreparedProblem& p, int count, const std::function<Eigen::VectorXd(int)>& start, bool from_start,
             const RunSettings& run_settings, const Settings& s, const Control& control, Progress* progress,
             SearchRound& round) {
  const std::size_t before = round.runs.size();
  round.runs.resize(before + at_index(count));
  round.from_start.resize(round.runs.size(), from_start);
  parallel_for(count, 1, s.threads, [&](long first, long) {
    if (control.stop.stop_requested()) return;
    LocalRun run = run_from_start(p, start(static_cast<int>(first)), Formulation::minimax, run_settings, control.stop);
    if (progress != nullptr) progress->finished(run.end);
    round.runs[before + at_index(first)] = std::make_unique<LocalRun>(std::move(run));
  });
}

/// The same from a list.
void run_all(const PreparedProblem& p, const std::vector<Eigen::VectorXd>& starts, bool from_start,
             const RunSettings& run_settings, const Settings& s, const Control& control, SearchRound& round,
             Progress* progress = nullptr) {
  const auto at = [&](int k) { return starts[at_index(k)]; };
  run_all(p, static_cast<int>(starts.size()), at, from_start, run_settings, s, control, progress, round);
}

/// Violation of every short run, as the logarithm of a ratio, beyond which there is probably no design within the
/// limits: the runs to the end then take one attempt each, and a search for the least violation says what excludes
/// what.
constexpr double far_from_all = 1e-2;

/// How many of `starts` are run to their end after a short run of each.
int full_run_count(int starts) {
  return std::min(starts, std::max(least_full_runs, starts / 8));
}

/// The most promising starts of a batch, by a short run of each.
std::vector<Eigen::VectorXd> promising_starts(const Batch& batch, double size_limit, const Control& control,
                                              Progress& progress, SearchRound& round, bool& none_near) {
  const PreparedProblem& p = batch.p;
  const PreparedProblem scout(with_stated_internal_points(p.problem), size_limit);
  const int warm = batch.warm();
  const auto start = [&](int k) {
    const Eigen::VectorXd x = p.coordinates.variables(batch.start(warm + k));
    return scout.coordinates.coordinates(x.head(static_cast<Eigen::Index>(scout.problem.names().size())));
  };
  SearchRound short_runs;
  run_all(scout, batch.count() - warm, start, true,
          {short_run_evaluations + evaluations_per_variable * scout.coordinates.size(), 0, false}, batch.s, control,
          &progress, short_runs);
  // Warm starts are all run to their end.
  std::vector<Eigen::VectorXd> out;
  for (int k = 0; k < warm; ++k) out.push_back(batch.start(k));
  int done = warm;
  if (const auto order = ranked(short_runs); !order.empty())
    none_near = short_runs.runs[order.front()]->end.constraint_violation > far_from_all;
  const auto full_runs = at_index(full_run_count(batch.count() - warm) + warm);
  for (const std::size_t k : ranked(short_runs)) {
    round.evaluations += short_runs.runs[k]->evaluations;
    ++done;
    if (out.size() < full_runs) out.push_back(with_zero_offsets(p, short_runs.runs[k]->end.variables));
  }
  round.done += done;
  round.runs_abandoned += done - static_cast<int>(out.size());
  // Of what was stopped here the best is all there is.
  if (control.stop.stop_requested() && out.size() > at_index(warm)) {
    round.runs.push_back(std::make_unique<LocalRun>(LocalRun{candidate_at(p, out[at_index(warm)])}));
    round.from_start.push_back(true);
  }
  return out;
}

/// Starts that take some coordinates from one of the best end points and the others from a new start. Local optima
/// differ by a few choices (a height up or down, a triple inside or outside), and a good design has most of them right.
std::vector<Eigen::VectorXd> recombined(const PreparedProblem& p, const Settings& s, const SearchRound& round,
                                        int count) {
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
  for (int k = round.recombined; k < round.recombined + count && !bases.empty(); ++k) {
    // Better designs are chosen more often.
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

/// How many recombined starts for so many runs: more for more variables.
int extra_start_count(const PreparedProblem& p, std::size_t runs) {
  const double share = std::min(1.0, p.coordinates.size() / 25.0);
  return std::max(1, static_cast<int>(share * static_cast<double>(runs)));
}

/// Whether enough runs have the best objective.
bool starts_agree(const SearchRound& round) {
  const std::vector<std::size_t> order = ranked(round);
  if (order.empty()) return true;
  const Candidate& best = round.runs[order.front()]->end;
  if (!best.feasible()) return true;  // recombining infeasible designs does not help
  const auto same = std::ranges::count_if(order, [&](std::size_t k) {
    const Candidate& c = round.runs[k]->end;
    return c.feasible() && c.objective <= best.objective * (1.0 + agreed);
  });
  return static_cast<double>(same) >= agreement * static_cast<double>(order.size());
}

}  // namespace

int start_count(const PreparedProblem& p, const Settings& s) {
  return p.coordinates.size() == 0 ? 1 : s.starts + static_cast<int>(s.warm.size());
}

void run_batch(const PreparedProblem& p, double size_limit, const std::vector<Eigen::VectorXd>& further,
               const Settings& s, const Control& control, Progress& progress, SearchRound& round) {
  RunSettings full_run{s.max_evaluations};
  if (s.starts == 0) full_run.restarts = 0;  // warm starts alone are near an optimum
  const bool quick = places_quickly(p);
  if (quick) full_run.restarts = 0;
  const Batch batch{p, s, round.batches++};
  round.warm += p.coordinates.size() > 0 ? batch.warm() : 0;
  const std::size_t before = round.runs.size();
  // Starts are expensive with many poses, or if the index has kinks that are smoothed.
  if ((p.objective_poses > 1 || p.has_kinks()) && p.coordinates.size() > 0) {
    progress.expect(full_run_count(batch.count() - batch.warm()));
    bool none_near = false;
    std::vector<Eigen::VectorXd> chosen = promising_starts(batch, size_limit, control, progress, round, none_near);
    if (none_near) full_run.restarts = 0;
    if (quick) {
      const std::vector<Eigen::VectorXd> cold(chosen.begin() + batch.warm(), chosen.end());
      std::ranges::copy(placed(p, cold, s, control), chosen.begin() + batch.warm());
    }
    run_all(p, chosen, true, full_run, s, control, round, &progress);
  } else {
    run_all(p, batch.count(), [&](int k) { return batch.start(k); }, true, full_run, s, control, &progress, round);
    for (std::size_t k = before; k < round.runs.size(); ++k) round.done += round.runs[k] != nullptr;
  }
  if (batch.number == 0) {
    std::vector<Eigen::VectorXd> more;
    for (const Eigen::VectorXd& x : further) more.push_back(p.coordinates.coordinates(x));
    run_all(p, more, false, full_run, s, control, round);
  }
  if (p.coordinates.size() > 1 && s.starts > 1 && !starts_agree(round)) {
    const int count = extra_start_count(p, round.runs.size() - before);
    const std::vector<Eigen::VectorXd> starts = recombined(p, s, round, count);
    run_all(p, quick ? placed(p, starts, s, control) : starts, false, full_run, s, control, round);
    round.recombined += count;
  }
  for (std::size_t k = before; k < round.runs.size(); ++k)
    if (round.runs[k]) round.evaluations += round.runs[k]->evaluations;
}

bool starts_disagree(const SearchRound& round, const std::vector<Candidate>& candidates) {
  const std::optional<Candidate> feasible = best_feasible(round);
  if (!feasible) return round.done < enough;
  if (candidates.empty() || feasible->objective < candidates.front().objective * (1.0 - noticeable_gain)) return true;
  const int reached = candidates.front().reached;
  return reached < enough && reached <= agreement * (round.done - round.runs_abandoned);
}

}  // namespace ninedof
