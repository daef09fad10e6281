/// Declared in ninedof/optimize/region_placement.hpp.
///
/// The value of a pose is the least excess over O, and its derivative with respect to the design that of the rows which
/// hold it there (envelope theorem).

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "math/slsqp.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "ninedof/optimize/region_placement.hpp"
#include "optimize/minimax/placed_pose.hpp"
#include "optimize/region/posed.hpp"
#include "optimize/verdict.hpp"
#include "problem/constraints/solver_rows.hpp"

namespace ninedof {
namespace {

constexpr double program_tolerance = 1e-12;
constexpr int program_evaluations = 300;
constexpr int most_repeats = 3;
constexpr double nearly_feasible = 1e-3, no_change = 1e-8;
constexpr double far_within = -0.1;  // a pose with so much to spare need not be placed further

/// The variables of the solver are the free coordinates of the design, the low ends of the ranges, and the level of the
/// index: the least excess of every pose is at most zero.
class PlacedProgram {
 public:
  PlacedProgram(const Problem& problem, const std::vector<Pose>& poses, const PlacedDesign& start)
      : poses_(poses),
        coordinates_(problem, size_limits(problem).front()),
        shifts_(start.shifts),
        variables_(start.variables) {
    goal_.ranges = leg_ranges(problem);
    for (const LegRange& range : goal_.ranges) {
      first_.push_back(groups_);
      groups_ += groups_of(range);
    }
    pose_ = std::make_unique<PlacedPose>(problem, variables_, goal_);
  }

  PlacedDesign solve(const Control& control) {
    const Eigen::Index n = coordinates_.size();
    Eigen::VectorXd y(n + groups_ + 1);
    y.head(n) = coordinates_.coordinates(variables_);
    start_ranges(y);
    set(y);
    std::vector<PlacedPose::Outer> rows;
    evaluate(rows);
    keep_best(y, rows);  // a stop may come before any other design
    Nlp nlp;
    nlp.variables = y.size();
    for (const auto& r : rows) nlp.constraints += r.value.size();
    nlp.constraints += 1;
    nlp.low = Eigen::VectorXd::Constant(y.size(), -infinity);
    nlp.high = -nlp.low;
    nlp.low.head(n) = coordinates_.low();
    nlp.high.head(n) = coordinates_.high();
    nlp.evaluate = [&](const Eigen::VectorXd& at, Nlp::Values& out) {
      if (control.stop.stop_requested()) return false;
      set(at);
      evaluate(rows);
      fill(at, rows, out);
      keep_best(at, rows);
      return true;
    };
    const Eigen::VectorXd end = slsqp(nlp, y, {program_tolerance, program_evaluations});
    if (control.stop.stop_requested()) return best_;
    set(end);
    evaluate(rows);
    keep_best(end, rows);
    return best_;
  }

 private:
  void start_ranges(Eigen::VectorXd& y) {
    const Eigen::Index n = coordinates_.size();
    set_sizes();
    Vec9 low = Vec9::Constant(infinity), high = Vec9::Zero();
    double index = -infinity;
    pose_->set_design(variables_);
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      pose_->set_pose(poses_[k]);
      const PlacedEnd end = pose_->end({Vec6::Zero(), shifts_[k]});
      index = std::max(index, end.log_index);
      low = low.cwiseMin(pose_->lengths());
      high = high.cwiseMax(pose_->lengths());
    }
    for (std::size_t r = 0; r < goal_.ranges.size(); ++r) {
      LegRange& range = goal_.ranges[r];
      range.surround(low, high);
      y.segment(n + first_[r], groups_of(range)) = range.low.head(groups_of(range));
    }
    y[n + groups_] = index;
  }

  /// How many ends a range has among the variables: all legs may have one.
  static Eigen::Index groups_of(const LegRange& range) { return range.spread.each_leg ? 9 : 1; }

  void set_sizes() {
    pose_->set_design(variables_);
    for (LegRange& range : goal_.ranges) range.set_zp(pose_->zp());
  }

  void set(const Eigen::VectorXd& y) {
    const Eigen::Index n = coordinates_.size();
    variables_ = coordinates_.variables(y.head(n));
    set_sizes();
    for (std::size_t r = 0; r < goal_.ranges.size(); ++r) {
      LegRange& range = goal_.ranges[r];
      for (Eigen::Index leg = 0; leg < 9; ++leg) range.low[leg] = y[n + first_[r] + (range.spread.each_leg ? leg : 0)];
      range.high = range.low + Vec9::Constant(range.width());
    }
    goal_.log_index = y[n + groups_];
  }

  void evaluate(std::vector<PlacedPose::Outer>& rows) {
    rows.clear();
    rows.push_back(pose_->of_design());
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      pose_->set_pose(poses_[k]);
      if (optimizes_internal_point(poses_[k])) {
        pose_->place(shifts_[k], far_within);
        rows.push_back(pose_->least(shifts_[k]));
      } else rows.push_back(pose_->all(shifts_[k]));
    }
  }

  void fill(const Eigen::VectorXd& y, const std::vector<PlacedPose::Outer>& rows, Nlp::Values& out) const {
    const Eigen::Index n = coordinates_.size();
    const Eigen::VectorXd slopes = coordinates_.slopes(variables_);
    out.f = y[n + groups_];
    out.f_gradient.setZero();
    out.f_gradient[n + groups_] = 1.0;
    out.c_gradient.setZero();
    Eigen::Index c = 0;
    for (const PlacedPose::Outer& some : rows)
      for (Eigen::Index k = 0; k < some.value.size(); ++k, ++c) {
        out.c[c] = some.value[k];
        auto g = out.c_gradient.row(c);
        for (Eigen::Index v = 0; v < n; ++v)
          g[v] = slopes[v] * some.by_variables(k, coordinates_.variable(static_cast<int>(v)));
        for (std::size_t r = 0; r < goal_.ranges.size(); ++r)
          for (Eigen::Index leg = 0; leg < 9; ++leg)
            g[n + first_[r] + (goal_.ranges[r].spread.each_leg ? leg : 0)] +=
                some.by_ranges(k, 9 * static_cast<Eigen::Index>(r) + leg);
        g[n + groups_] = some.by_index[k];
      }
    out.c[c] = -coordinates_.order_margin(y.head(n));
    out.c_gradient.row(c).head(n) = -coordinates_.order().gradient.transpose();
  }

  void keep_best(const Eigen::VectorXd& y, const std::vector<PlacedPose::Outer>& rows) {
    double violation = -coordinates_.order_margin(y.head(coordinates_.size()));
    for (const PlacedPose::Outer& some : rows)
      if (some.value.size() > 0) violation = std::max(violation, some.value.maxCoeff());
    // A small violation of the index is one of its level.
    const double merit = goal_.log_index + std::max(violation, 0.0) * violation_price;
    if (!best_.shifts.empty() && merit >= best_merit_) return;
    best_merit_ = merit;
    best_ = {variables_, shifts_, goal_.log_index, violation};
  }

  static constexpr double violation_price = 100.0;
  const std::vector<Pose>& poses_;
  Coordinates coordinates_;
  std::vector<Vec3> shifts_;
  Eigen::VectorXd variables_;
  PlacementGoal goal_;
  std::vector<Eigen::Index> first_;  // end of each range among the variables
  Eigen::Index groups_ = 0;
  std::unique_ptr<PlacedPose> pose_;
  PlacedDesign best_;
  double best_merit_ = infinity;
};

/// Start `k` of the low-discrepancy sequence, O shifted and held by turns.
PlacedDesign start_design(const Problem& problem, const std::vector<Pose>& poses, int k, std::uint64_t seed) {
  const Coordinates coordinates(problem, size_limits(problem).front());
  PlacedDesign out{coordinates.variables(coordinates.start(k, seed)), {}};
  const double zp = out.variables[design_family(problem.family).index("zp")];
  for (const Pose& pose : poses) {
    const bool shifted = optimizes_internal_point(pose) && k % 2 == 0;
    out.shifts.push_back(shifted ? shifted_with(pose, zp) : Vec3(Vec3::Zero()));
  }
  return out;
}

}  // namespace

std::vector<PlacedDesign> optimize_placed(const Problem& problem, const std::vector<PlacedDesign>& given,
                                          const PlacedSettings& settings, const Control& control) {
  problem.validate();
  Problem alone = problem;
  alone.objective.poses.clear();
  const std::vector<Pose>& poses = problem.objective.poses;
  if (poses.empty()) throw InvalidArgument("poses", "none", "one or more");
  for (const PlacedDesign& start : given) {
    require_full("variables", alone, start.variables);
    if (start.shifts.size() != poses.size())
      throw InvalidArgument("shifts", std::to_string(start.shifts.size()), "one for each pose");
  }
  const auto first = static_cast<long>(given.size());
  std::vector<PlacedDesign> out(at_index(first + settings.starts));
  parallel_for(first + settings.starts, 1, settings.threads, [&](long k, long) {
    if (control.stop.stop_requested()) return;
    const PlacedDesign start =
        k < first ? given[at_index(k)] : start_design(alone, poses, static_cast<int>(k - first), settings.seed);
    PlacedDesign end = PlacedProgram(alone, poses, start).solve(control);
    const auto stopped = [&] { return control.stop.stop_requested(); };
    for (int again = 0; again < most_repeats && end.violation < nearly_feasible && !stopped(); ++again) {
      PlacedDesign next = PlacedProgram(alone, poses, end).solve(control);
      const bool settled = next.violation < nearly_feasible && next.violation >= -1.0 &&
                           std::abs(next.log_objective - end.log_objective) < no_change;
      if (next.violation < std::max(end.violation, 1e-9) || next.log_objective < end.log_objective) end = next;
      if (settled) break;
    }
    out[at_index(k)] = std::move(end);
  });
  if (control.stop.stop_requested()) throw Stopped{};
  return out;
}

}  // namespace ninedof
