#include "optimize/region/placed_study.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "limits/table.hpp"
#include "math/numbers.hpp"
#include "math/sort_by.hpp"
#include "optimize/minimax/local_run.hpp"
#include "optimize/polish/active_set.hpp"
#include "optimize/region/conflict_poses.hpp"
#include "optimize/region/exchange.hpp"
#include "optimize/region/look.hpp"
#include "optimize/region/placed_poses.hpp"
#include "optimize/verdict.hpp"

namespace ninedof {
namespace {

constexpr double passed_placed = 1e-7;
constexpr double nearly = 1e-5;   // violation up to which an end of the quick solver is a design
constexpr double ample = 0.03;     // a pose where O leaves so much to spare does not rule
constexpr double rules = 1e-5;    // one that leaves more decides nothing at the end
constexpr double agree = 1e-6;    // of logarithms of the index: starts that agree
constexpr int placed_share = 8;          // one start in so many is run with O placed; the others with O shifted
constexpr int settles = 12;       // rounds after which poses are added only, so that the exchange comes to an end

/// The least and greatest length of each leg that limits at the poses allow.
LegLimits allowed_lengths(const Problem& problem, double zp) {
  LegLimits out{Vec9::Zero(), Vec9::Constant(infinity)};
  for (const Limit& limit : problem.limits) {
    const PoseRow* row = limit_row(limit.name).pose;
    if (row == nullptr || row->first_leg < 0 || limit.at != LimitAt::poses) continue;
    const double unit = limit.of == Unit::zp ? zp : 1.0;
    for (int leg = row->first_leg; leg < row->first_leg + row->items; ++leg) {
      out.low[leg] = std::max(out.low[leg], unit * std::max(limit.low, 0.0));
      out.high[leg] = std::min(out.high[leg], unit * limit.high);
    }
  }
  return out;
}

class PlacedStudy {
 public:
  /// `control` has the end of the time too, `caller` has not.
  PlacedStudy(const Problem& problem, const Region& region, const RegionStudySettings& settings, const Control& control,
              const Control& caller, RegionResult shifted)
      : problem_(problem),
        region_(region),
        poses_(problem, region),
        settings_(settings),
        control_(control),
        caller_(caller),
        shifted_(std::move(shifted)) {}

  RegionResult solve() {
    out_.result.evaluations = shifted_.result.evaluations;
    try {
      begin();
      next_round();
      if (!solve_quickly(quick_starts()) || !settle()) return unfinished();
      if (settings_.starts > 1 && !try_another_basin()) return unfinished();
      if (!place_exactly()) return unfinished();
    } catch (const Stopped&) {
      return unfinished();
    }
    return finished();
  }

 private:
  RegionSettings how(long samples) const {
    return {
        .samples = samples, .seed = settings_.seed + static_cast<std::uint64_t>(rounds_), .threads = settings_.threads};
  }
  /// Begins a round; `settling`: how many designs before it passed between the poses, the last as `look_` has it.
  void next_round(int settling = 0) {
    ++rounds_;
    clock_.begin();
    if (!settings_.phase) return;
    std::string text =
        "O placed, round " + std::to_string(rounds_) + ", at " + std::to_string(state_.ruling.size()) + " poses";
    if (settling > 0)
      text +=
          so_far(std::exp(state_.design.log_objective), look_.worse.front().excess, settling, passed_placed, clock_);
    settings_.phase(text);
  }

  /// The corners and the greatest turns, and O as the optimum with O shifted has it.
  void begin() {
    const auto& candidates = shifted_.result.candidates;
    for (const Vec6& at : coarse_cover(region_)) state_.ruling.push_back({at, Vec3::Zero()});
    known_ = !candidates.empty();
    if (!known_) return;
    const Eigen::VectorXd& x = candidates.front().variables;
    state_.design = poses_.state(x, {}, 0.0).design;
    for (Placed& placed : state_.ruling) placed.shift = poses_.shifted(placed.at, state_.design);
    follow_ruling();
  }

  int quick_starts() const { return (settings_.starts + placed_share - 1) / placed_share; }

  /// All starts once more, at the poses that decide, as other designs may be better there.
  bool try_another_basin() {
    const PlacedState before = state_;
    const PlacedLook look = look_;
    state_.ruling = poses_.deciding(state_, look_);
    follow_ruling();
    next_round();
    if (!solve_quickly(quick_starts())) return false;
    const auto gained = [&](double by) { return state_.design.log_objective < before.design.log_objective - by; };
    if (gained(agree)) {
      if (!settle()) return false;
      if (gained(0.0)) return true;
    }
    state_ = before;
    look_ = look;
    return true;
  }

  bool solve_quickly(int starts) {
    const Problem there = poses_.posed(state_.ruling);
    const std::vector<PlacedDesign> given = known_ ? std::vector{state_.design} : std::vector<PlacedDesign>{};
    std::vector<PlacedDesign> ends =
        optimize_placed(there, given, {starts, settings_.seed, settings_.threads}, control_);
    std::erase_if(ends, [](const PlacedDesign& end) { return !(end.violation <= nearly); });
    if (ends.empty()) return false;
    sort_by(ends, &PlacedDesign::log_objective);
    if (starts > 0) {
      tried_ = static_cast<int>(given.size()) + starts;
      reached_ = static_cast<int>(std::ranges::count_if(
          ends, [&](const PlacedDesign& end) { return end.log_objective <= ends.front().log_objective + agree; }));
    }
    state_.design = ends.front();
    known_ = true;
    const std::size_t listed = problem_.objective.poses.size();
    for (std::size_t k = 0; k < state_.ruling.size(); ++k) state_.ruling[k].shift = state_.design.shifts[listed + k];
    return true;
  }

  /// Gives the design the shifts of the poses that rule now.
  void follow_ruling() {
    state_.design.shifts.resize(problem_.objective.poses.size());
    for (const Placed& placed : state_.ruling) state_.design.shifts.push_back(placed.shift);
  }

  /// Looks at the design, and remembers the best one that keeps its limits: all there is if a stop comes.
  void look_over(long samples) {
    look_ = poses_.look(state_, how(samples), passed_placed, control_);
    const double best = seen_ ? seen_->second.worst.log_index : std::log(shifted_objective());
    if (look_.margin >= -passed_placed && look_.worst.log_index < best) seen_ = {state_, look_};
  }

  double shifted_objective() const { return shifted_.result.candidates.empty() ? infinity : shifted_.region.objective; }

  /// Takes the design remembered, where the time ended looked at densely: how good it is has to be known.
  bool take_seen() {
    if (!seen_) return false;
    std::tie(state_, look_) = *seen_;
    try {
      look_ = poses_.look(state_, how(dense_samples), passed_placed, caller_);
    } catch (const Stopped&) {
    }
    if (look_.margin < -passed_placed || !(std::exp(look_.worst.log_index) < shifted_objective())) return false;
    const Problem there = poses_.posed(state_.ruling);
    const PreparedProblem p(there, size_limits(there).back());
    found_ = {};
    found_.candidates = {candidate_at(p, p.coordinates.coordinates(poses_.variables(state_)))};
    return true;
  }

  /// Rounds with a quick solver, to which O is no variable.
  bool settle() {
    for (int round = 0; round < most_exchanges; ++round) {
      look_over(quick_samples);
      if (poses_.nothing_new(state_, look_) || round + 1 == most_exchanges) return true;
      state_.ruling = poses_.joined(round < settles ? poses_.kept(state_, look_, ample) : state_.ruling, look_);
      follow_ruling();
      next_round(round + 1);
      if (!solve_quickly(0)) return false;
    }
    return true;
  }

  /// The design with O as variables of the poses that decide.
  bool place_exactly() {
    state_.ruling = poses_.deciding(state_, look_);
    follow_ruling();
    for (int round = 0; round < most_exchanges; ++round) {
      next_round();
      Settings warm = settings_;
      warm.starts = 0;
      warm.warm = {poses_.variables(state_)};
      found_ = optimize(poses_.posed(state_.ruling), warm, {control_.stop, {}});
      out_.result.evaluations += found_.evaluations;
      if (control_.stop.stop_requested()) throw Stopped{};
      if (found_.candidates.empty()) return false;
      const Candidate& best = found_.candidates.front();
      state_ = poses_.state(best.variables, state_.ruling, std::log(best.objective));
      look_over(quick_samples);
      if (poses_.nothing_new(state_, look_)) look_over(dense_samples);
      if (poses_.nothing_new(state_, look_) || round + 1 == most_exchanges) return true;
      state_.ruling = poses_.replaced(state_, look_);
      follow_ruling();
      if (!solve_quickly(0)) return false;
    }
    return true;
  }

  RegionResult finished() {
    const Candidate best = found_.candidates.front();
    const PlacedState full = state_;
    state_.ruling = poses_.kept(full, look_, rules);
    follow_ruling();
    const Problem there = poses_.posed(state_.ruling);
    Candidate kept = best;
    kept.variables = poses_.variables(state_);
    kept.conditions = conditions_of(best, full);
    kept.reached = reached_;
    const auto evaluations = out_.result.evaluations;
    out_.result = found_;
    out_.result.evaluations = evaluations;
    out_.result.candidates = {kept};
    const int abandoned = std::max(settings_.starts - tried_, 0);
    out_.result.starts_done = tried_ + abandoned;
    out_.result.runs_abandoned = abandoned;
    out_.result.runs_completed = tried_;
    const double gain = gain_left(best, full);
    conclude(out_.result, look_.worse.empty(), rounds_, best, gain);
    for (const Placed& placed : state_.ruling) {
      out_.region.poses.push_back(region_.pose(placed.at));
      out_.region.poses.back().internal.setZero();
      out_.region.poses.back().best_internal = true;
    }
    out_.region.rounds = rounds_;
    out_.region.looked_at = look_.poses;
    out_.region.objective = std::exp(look_.worst.log_index);
    out_.region.objective_at = poses_.pose(look_.worst.placed, full.design);
    out_.region.margin = look_.margin;
    out_.region.limit = look_.limit;
    out_.region.gain = gain;
    const double zp = poses_.zp(full.design);
    const std::vector<LegRange> ranges = leg_ranges(poses_.alone(), zp, poses_.lengths(full));
    if (!ranges.empty()) out_.region.leg_ranges = common_range(ranges, allowed_lengths(problem_, zp));
    return std::move(out_);
  }

  /// See RegionReport::gain: what the index and the limits pass, at the dearest price, and the slack of the optimum.
  double gain_left(const Candidate& best, const PlacedState& full) const {
    const Problem there = poses_.posed(full.ruling);
    const PreparedProblem p(there, size_limits(there).back());
    double price = 1.0, violated = 0.0;
    for (const auto& [name, of] : best.prices) price = std::max(price, of);
    for (const PlacedEnd& end : look_.worse) violated = std::max(violated, end.excess);
    return std::max({0.0, look_.worst.log_index - full.design.log_objective, price * violated}) +
           least_slack(p, p.coordinates.coordinates(best.variables));
  }

  /// The condition numbers at the listed poses and at those that are left.
  std::vector<double> conditions_of(const Candidate& best, const PlacedState& full) const {
    const std::size_t listed = problem_.objective.poses.size();
    std::vector<double> out(best.conditions.begin(), best.conditions.begin() + static_cast<long>(listed));
    for (const Placed& placed : state_.ruling) {
      const auto at = std::ranges::find(full.ruling, placed.at, &Placed::at);
      out.push_back(best.conditions[listed + static_cast<std::size_t>(at - full.ruling.begin())]);
    }
    return out;
  }

  /// The best design seen with O placed, the optimum with O shifted, or why there is no design.
  RegionResult unfinished() {
    const bool stopped = control_.stop.stop_requested();
    if (stopped && take_seen()) {
      RegionResult out = finished();
      out.result.status = Status::stopped;
      out.result.reason = "ended in round " + std::to_string(rounds_) +
                          " of placing O; the best design so far, not an optimum of the region";
      return out;
    }
    RegionResult out = std::move(shifted_);
    if (out.result.candidates.empty() && !stopped) {
      const Problem there = poses_.posed(state_.ruling);
      Settings cold = settings_;
      cold.warm.clear();  // these have no variables for O
      Result found = optimize(there, cold, control_);
      found.evaluations += out.result.evaluations;
      out.region.poses.assign(there.objective.poses.end() - static_cast<long>(state_.ruling.size()),
                              there.objective.poses.end());
      name_conflict(found, problem_.objective.poses.size(), out.region.poses);
      if (found.candidates.empty()) return {std::move(found), out.region};
      found.candidates.clear();
      found.reason =
          "no start with O placed ended within the limits at all poses, although there is a design for the first ones: "
          "raise starts";
      found.status = Status::stopped;
      return {std::move(found), out.region};
    }
    out.result.status = Status::stopped;
    out.result.reason = stopped ? "ended while O was being placed; the design is the optimum with O shifted"
                                : "no start with O placed passed the checks; the design is the optimum with O shifted";
    out.region.gain = infinity;  // with O placed it may be better by any amount
    return out;
  }

  const Problem& problem_;
  const Region& region_;
  PlacedPoses poses_;
  const RegionStudySettings& settings_;
  const Control& control_;
  const Control& caller_;
  RegionResult shifted_, out_;
  PlacedState state_;
  PlacedLook look_;
  std::optional<std::pair<PlacedState, PlacedLook>>
      seen_;  // the best design that keeps its limits, as it was looked at
  Result found_;
  bool known_ = false;  // whether the state has a design
  int rounds_ = 0, tried_ = 0, reached_ = 0;
  RoundClock clock_;
};

}  // namespace

RegionResult optimize_region_placed(const Problem& problem, const Region& region, const RegionStudySettings& settings,
                                    const Control& control, const Control& caller, RegionResult shifted) {
  return PlacedStudy(problem, region, settings, control, caller, std::move(shifted)).solve();
}

}  // namespace ninedof
