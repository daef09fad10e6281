#include "ninedof/optimize/region_study.hpp"

#include <cmath>
#include <cstdio>

#include "math/numbers.hpp"
#include "math/time_limit.hpp"
#include "ninedof/math/error.hpp"
#include "optimize/region/conflict_poses.hpp"
#include "optimize/region/exchange.hpp"
#include "optimize/region/mean.hpp"
#include "optimize/region/placed_study.hpp"
#include "optimize/verdict.hpp"

namespace ninedof {
namespace {

constexpr int start_nodes = 16;  // where all starts are run: enough to tell good designs from bad ones
constexpr int first_nodes = 64, most_nodes = 256;  // of a quadrature; doubled while its error is larger than
constexpr double mean_tolerance = 2e-3;  // relative
constexpr int most_searches = 3;  // from all starts, where poses have joined that exclude every design so far
constexpr double ruling =
    1e-5;  // relative: a pose where nothing is as near to its limit or to the worst decides nothing

class RegionStudy {
 public:
  /// `control` has the end of the time too, `caller` has not.
  RegionStudy(const Problem& problem, const Region& region, const RegionStudySettings& settings, const Control& control,
              const Control& caller)
      : problem_(problem),
        region_(region),
        settings_(settings),
        control_(control),
        caller_(caller),
        exchange_(problem, region, settings, control) {}

  RegionResult solve() {
    first_.at = cover(region_);
    if (is_mean()) first_.nodes = mean_nodes(region_, start_nodes, settings_.seed);
    for (int search = 0; search < most_searches; ++search) {
      if (!search_all(first_)) return ended();
      if (is_mean()) first_.nodes = mean_nodes(region_, first_nodes, settings_.seed);
      Imposed next = follow_all();
      const bool last = search + 1 == most_searches;
      if (last || best_.settled || control_.stop.stop_requested() || best_.best.feasible()) break;
      first_ = std::move(next);  // these exclude what was found: is there another design?
      best_ = {};
    }
    if (is_mean()) refine_mean();
    return ended();
  }

 private:
  /// Solves at the poses alone, from all starts; false where that ends the study.
  bool search_all(const Imposed& at) {
    searched_ = at;
    if (settings_.phase) settings_.phase("all starts, at " + std::to_string(at.nodes.size() + at.at.size()) + " poses");
    Result found = optimize(posed(problem_, poses_of(problem_, region_, at)), settings_, control_);
    found.evaluations += out_.result.evaluations;
    found.starts_done += out_.result.starts_done;
    found.runs_abandoned += out_.result.runs_abandoned;
    out_.result = std::move(found);
    return !out_.result.candidates.empty() && !out_.result.interrupted && out_.result.status != Status::unbounded;
  }

  /// Follows every optimum of the poses alone that may still become the best. The poses that hold the best design so
  /// far are imposed on the next: a start that leads to the same design is known by its first round. So are those that
  /// excluded others, as long as there is no design. Returns what would be imposed on one more.
  Imposed follow_all() {
    best_ = {};
    Imposed from = first_;
    for (const Candidate& start : out_.result.candidates) {
      if (control_.stop.stop_requested()) break;
      if (best_.settled && start.objective >= best_.best.objective) continue;
      Settled found = exchange_.follow(from, start.variables, best_.rounds > 0 ? &best_ : nullptr);
      found.best.reached = start.reached;
      const bool better = found.settled != best_.settled ? found.settled
                          : found.best.feasible() != best_.best.feasible()
                              ? found.best.feasible()
                              : found.best.objective < best_.best.objective;
      if (!best_.settled && !found.best.feasible()) from.at = found.imposed.at;
      if (best_.rounds > 0 && !better) continue;
      best_ = std::move(found);
      if (!best_.settled) continue;
      from = first_;
      std::ranges::copy(exchange_.holding(best_.imposed, best_.best.variables).at, std::back_inserter(from.at));
    }
    return from;
  }

  bool is_mean() const { return problem_.objective.aggregate != Aggregate::worst; }
  bool out_of_time() const { return control_.stop.stop_requested() && !caller_.stop.stop_requested(); }

  RegionMean mean(const Settled& of, const Control& control) const {
    return region_mean(problem_, region_, of.imposed.nodes, of.best.variables, settings_.seed, settings_.threads,
                       control);
  }

  /// Doubles the nodes of the quadrature while its error is too large. A stop leaves the last design that is known.
  void refine_mean() {
    while (best_.settled && !control_.stop.stop_requested()) {
      try {
        average_ = mean(best_, control_);
      } catch (const Stopped&) {
        return;
      }
      const auto nodes = static_cast<int>(best_.imposed.nodes.size());
      if (average_->error <= mean_tolerance * average_->value || nodes >= most_nodes) return;
      Imposed more{mean_nodes(region_, 2 * nodes, settings_.seed), best_.imposed.at};
      Settled next = exchange_.follow(more, best_.best.variables, nullptr);
      if (!next.settled) return;
      next.best.reached = best_.best.reached;
      best_ = std::move(next);
    }
  }

  /// The result. Where the time ended before the best design was looked at between the poses, it is looked at now: how
  /// good it is has to be known. Ctrl-C does not wait for that.
  RegionResult ended() {
    if (out_of_time()) {
      if (best_.rounds == 0 && !out_.result.candidates.empty()) {
        best_.best = out_.result.candidates.front();
        best_.imposed = searched_;
      }
      try {
        if (best_.best.feasible() && !best_.settled) {
          best_.look = exchange_.look(best_, dense_samples, caller_);
          best_.slack = exchange_.slack(best_);
        }
        if (is_mean() && best_.look.poses > 0) average_ = mean(best_, caller_);
      } catch (const Stopped&) {
      }
    }
    return best_.rounds > 0 || best_.look.poses > 0 ? finished() : unposed();
  }

  /// What there is where nothing was looked at over the region.
  RegionResult unposed() {
    if (control_.stop.stop_requested()) {
      out_.result.status = Status::stopped;
      out_.result.reason = out_.result.candidates.empty() ? "ended before there was a design"
                                                          : "ended before the design was looked at between the poses";
    }
    out_.region.poses = poses_of(problem_, region_, searched_);
    name_conflict(out_.result, problem_.objective.poses.size(), out_.region.poses);
    if (!out_.result.candidates.empty()) {
      out_.result.candidates.resize(1);
      out_.region.objective = out_.result.candidates.front().objective;
      out_.region.objective_at = out_.region.poses.front();
    }
    return std::move(out_);
  }

  /// No design is left: the poses that joined exclude all that were found.
  RegionResult excluded() {
    out_.region.poses = poses_of(problem_, region_, best_.imposed);
    out_.result.candidates.clear();
    out_.result.evaluations += exchange_.evaluations();
    out_.result.status = Status::stopped;
    out_.result.reason =
        "the poses of the last round exclude every design found before, though some starts find one at fewer poses: "
        "raise starts";
    return std::move(out_);
  }

  RegionResult finished() {
    Result& result = out_.result;
    if (!best_.best.feasible()) return excluded();
    if (best_.look.poses > 0) keep_ruling();
    out_.region.poses = poses_of(problem_, region_, best_.imposed);
    result.candidates = {best_.best};
    result.evaluations += exchange_.evaluations();
    out_.region.rounds = exchange_.rounds();
    out_.region.looked_at = best_.look.poses;
    out_.region.objective = best_.look.poses > 0 ? std::exp(best_.look.log_index) : best_.best.objective;
    out_.region.objective_at = best_.look.poses > 0 ? region_.pose(best_.look.log_index_at) : out_.region.poses.front();
    out_.region.margin = best_.look.poses > 0 ? best_.look.margin : infinity;
    out_.region.limit = best_.look.limit;
    out_.region.gain = best_.look.poses > 0 ? gain_of(best_) : infinity;
    out_.region.mean = average_;
    if (average_) {
      // The mean over poses that had no influence takes the place of the quadrature; in logarithms it has this share.
      const Objective& o = problem_.objective;
      const double share = o.aggregate == Aggregate::weighted ? 1.0 - o.weight : 1.0;
      result.candidates.front().objective *= std::pow(average_->value / average_->quadrature, share);
    }
    conclude(result, best_.settled, exchange_.rounds(), best_.best, out_.region.gain);
    if (control_.stop.stop_requested()) {
      result.status = Status::stopped;
      result.reason = reason_of_stop();
    }
    result.causes.clear();
    return std::move(out_);
  }

  std::string reason_of_stop() const {
    const std::string when = exchange_.rounds() > 0 ? "in round " + std::to_string(exchange_.rounds())
                                                    : std::string("before the first round");
    std::array<char, 200> text{};
    const int length =
        std::snprintf(text.data(), text.size(),
                      "ended %s; the best so far at the poses imposed, not an optimum of the region", when.c_str());
    if (best_.look.poses > 0)
      std::snprintf(text.data() + length, text.size() - at_index(length),
                    "; near this design at most %.1e is left to gain", gain_of(best_));
    return text.data();
  }

  /// Leaves out the poses that are far from deciding anything: it stays an optimum without them.
  void keep_ruling() {
    std::vector<Vec6> kept = nearly_deciding(problem_, region_, best_.imposed.at, best_.best.variables, ruling);
    if (kept.empty() && best_.imposed.nodes.empty()) kept.push_back(best_.imposed.at.front());
    best_.imposed.at = std::move(kept);
    const Eigen::VectorXd x = best_.best.variables;
    Candidate now = exchange_.at_imposed(best_.imposed, x);
    Imposed few = exchange_.holding(best_.imposed, x);
    if (Candidate among_few = exchange_.at_imposed(few, x); among_few.stationary()) {
      best_.imposed = std::move(few);
      now = std::move(among_few);
    }
    now.reached = best_.best.reached;
    best_.best = std::move(now);
  }

  const Problem& problem_;
  const Region& region_;
  const RegionStudySettings& settings_;
  const Control& control_;
  const Control& caller_;
  Exchange exchange_;
  Imposed first_, searched_;  // where designs are followed from; where all starts ran last
  Settled best_;
  std::optional<RegionMean> average_;
  RegionResult out_;
};

}  // namespace

RegionResult optimize_region(const Problem& problem, const Region& region, const RegionStudySettings& settings,
                             const Control& control) {
  problem.validate();
  region.validate();
  settings.validate();
  if (region.placed && problem.objective.aggregate != Aggregate::worst)
    throw InvalidArgument("objective", "a mean over a region with O placed", "the worst over it");
  const TimeLimit limit(settings.time_limit, control.stop);
  const Control limited{limit.stop(), control.progress};
  Region with_rule = region;
  with_rule.shifted |= region.placed;
  const auto solved = [&](const RegionStudySettings& how) {
    return RegionStudy(problem, with_rule, how, limited, control).solve();
  };
  RegionResult out = solved(settings);
  const bool ended = out.result.status != Status::stopped || limited.stop.stop_requested();
  if (out.result.candidates.empty() && !ended && !settings.warm.empty()) {
    RegionStudySettings cold = settings;  // known designs that the region excludes: the others followed them
    cold.warm.clear();
    out = solved(cold);
  }
  if (region.placed && limited.stop.stop_requested()) {
    out.result.reason = "ended before O was placed; the design is the optimum with O shifted so far";
    out.region.gain = infinity;  // with O placed it may be better by any amount
  } else if (region.placed && out.result.status != Status::unbounded) {
    with_rule.shifted = false;
    out = optimize_region_placed(problem, with_rule, settings, limited, control, std::move(out));
  }
  out.result.interrupted = control.stop.stop_requested();
  return out;
}

}  // namespace ninedof
