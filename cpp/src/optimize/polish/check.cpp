/// Declared in ninedof/optimize/check.hpp.

#include "ninedof/optimize/check.hpp"

#include <cmath>

#include "math/linear/least_squares.hpp"
#include "math/numbers.hpp"
#include "math/splitmix.hpp"
#include "ninedof/math/parallel.hpp"
#include "ninedof/optimize/evaluate.hpp"
#include "ninedof/optimize/region_placement.hpp"
#include "optimize/minimax/local_run.hpp"
#include "optimize/polish/active_set.hpp"
#include "optimize/region/look.hpp"
#include "optimize/region/mean.hpp"
#include "optimize/verdict.hpp"
#include "problem/full_variables.hpp"

namespace ninedof {
namespace {

constexpr double near_limit = 0.02;            // margins that the correction of a step keeps
constexpr double least_violation = 1e-12;      // rounding of a design on its limit
constexpr std::uint64_t of_checks = 2'000'029;  // apart from the seeds of the searches of a study

/// Steps from one design.
class Steps {
 public:
  Steps(const PreparedProblem& p, const Eigen::VectorXd& at, std::uint64_t seed)
      : p_(p), y_(p.with_auxiliary(at)), none_(selection_of(p)), seed_(seed) {
    DesignEvaluation design;
    design.state.length_joint = p.pieces(y_).front();
    evaluate_design(p, y_, design);
    log_objective_ = design.log_objective;
    allowed_ = std::max(violation(p, design, y_), least_violation);
    for (Eigen::Index k = 0; k < design.margins.size(); ++k)
      if (design.margins[k] <= near_limit) close_.push_back(k);
    slopes_ = design.margin_gradient(close_, Eigen::all);
  }

  /// The relative improvement by step `k`, and by its correction if it is not allowed: 0 if that is not either.
  std::pair<double, double> take(long k) const {
    DesignEvaluation design;
    const auto [gain, is_allowed] = judge(y_ + direction(k), design);
    if (!(gain > 0.0)) return {0.0, 0.0};
    if (is_allowed) return {gain, gain};
    if (close_.empty()) return {gain, 0.0};
    const Eigen::VectorXd missing = -design.margins(close_).cwiseMin(0.0);
    const Eigen::VectorXd corrected = y_ + direction(k) + least_norm(slopes_, missing);
    const auto [second, is_second_allowed] = judge(corrected, design);
    return {gain, is_second_allowed ? std::max(second, 0.0) : 0.0};
  }

 private:
  Eigen::VectorXd direction(long k) const {
    std::uint64_t next = stream(seed_, static_cast<std::uint64_t>(k));
    const auto uniform = [&next] { return uniform_from(++next * 0x9E3779B97F4A7C15ULL); };
    const Eigen::Index n = y_.size();
    Eigen::VectorXd out(n);
    for (double& x : out) x = 2.0 * uniform() - 1.0;
    if (k % 2 == 1 && n > 2)
      for (double& x : out) x *= uniform() * static_cast<double>(n) < 2.0 ? 1.0 : 0.0;
    return std::pow(10.0, -1.0 - static_cast<double>(k % step_sizes)) * out;
  }

  /// The relative improvement at coordinates that are moved within the bounds, and whether the design is allowed.
  std::pair<double, bool> judge(const Eigen::VectorXd& to, DesignEvaluation& design) const {
    const Eigen::VectorXd y = p_.with_auxiliary(to.cwiseMax(p_.coordinates.low()).cwiseMin(p_.coordinates.high()));
    design.state.length_joint = p_.pieces(y).front();
    evaluate_design(p_, y, design, &none_);
    return {-std::expm1(design.log_objective - log_objective_), violation(p_, design, y) <= allowed_};
  }

  const PreparedProblem& p_;
  Eigen::VectorXd y_;
  RowSelection none_;
  std::uint64_t seed_;
  double log_objective_ = 0.0, allowed_ = 0.0;
  std::vector<Eigen::Index> close_;
  Eigen::MatrixXd slopes_;
};

/// By how much ranges of lengths keep the limits that compare poses.
double margin_of_ranges(const Problem& problem, double zp, const LegLimits& lengths) {
  double out = infinity;
  for (LegRange& range : leg_ranges(problem)) {
    range.set_zp(zp);
    const auto measured = [&](double length) { return range.measured(length); };
    const Vec9 low = lengths.low.unaryExpr(measured), high = lengths.high.unaryExpr(measured);
    const double spread = range.spread.each_leg ? (high - low).maxCoeff() : high.maxCoeff() - low.minCoeff();
    out = std::min(out, range.spread.ratio ? 1.0 - std::exp(spread) / range.most : 1.0 - spread);
  }
  return out;
}

/// The same with O placed anew at every pose.
RegionCheck check_placed(const Problem& problem, const Region& region, const Eigen::VectorXd& x,
                         const std::optional<LegLimits>& lengths, const RegionSettings& settings,
                         const Control& control) {
  const Problem alone = without_poses(problem);
  const Eigen::VectorXd own = own_variables(problem, x);
  const double zp = x[design_family(problem.family).index("zp")];
  PlacementGoal goal{evaluate(problem, x).log_objective, {}};
  RegionCheck out;
  out.margin = infinity;
  if (lengths) {
    goal.ranges.push_back(range_of(*lengths));
    out.margin = margin_of_ranges(alone, zp, *lengths);
  }
  std::vector<Placed> known;
  for (std::size_t k = 0; k < problem.objective.poses.size(); ++k) {
    Pose pose = problem.objective.poses[k];
    Placed placed{Vec6::Zero(), pose.internal / (pose.in_zp ? 1.0 : zp)};
    if (pose.in_zp != region.in_zp) pose.position *= pose.in_zp ? zp : 1.0 / zp;
    placed.at = region.nearest(region.coordinates(pose));
    const std::array<int, 3> offset = offset_variables(problem, k);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (offset[axis] >= 0) placed.shift[static_cast<Eigen::Index>(axis)] = x[offset[axis]];
    known.push_back(placed);
  }
  const PlacedWorst worst = search_region_placed(alone, region, own, goal, known, settings, control);
  out.excess = -out.margin;
  double log_index = -infinity;
  for (const PlacedEnd& end : worst.ends) {
    out.excess = std::max(out.excess, end.excess);
    out.margin = std::min(out.margin, end.margin);
    log_index = std::max(log_index, end.log_index);
  }
  out.index = std::exp(log_index);
  out.poses = worst.poses;
  return out;
}

}  // namespace

OptimumCheck check_optimum(const Problem& problem, const Eigen::VectorXd& variables,
                           const OptimumCheckSettings& settings, const Control& control) {
  problem.validate();
  require_full("variables", problem, variables);
  const PreparedProblem p(problem, size_limits(problem).back());
  const Eigen::VectorXd y = p.coordinates.coordinates(variables);
  const Candidate design = candidate_at(p, y);
  OptimumCheck out{design.optimality_residual, static_cast<int>(design.active.size())};
  if (p.coordinates.size() == 0) return out;
  out.steps = settings.steps;
  const Steps steps(p, y, settings.seed);
  std::vector<std::pair<double, double>> gains(at_index(settings.steps));
  parallel_for(settings.steps, 32, settings.threads, [&](long first, long last) {
    for (long k = first; k < last && !control.stop.stop_requested(); ++k) gains[at_index(k)] = steps.take(k);
  });
  if (control.stop.stop_requested()) throw Stopped{};
  for (const auto& [any, within] : gains) {
    out.better += any > 0.0 ? 1 : 0;
    out.gain = std::max(out.gain, within);
  }
  return out;
}

RegionCheck check_region(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                         const std::optional<LegLimits>& leg_ranges, std::uint64_t seed, const Control& control) {
  problem.validate();
  region.validate();
  require_full("variables", problem, variables);
  const std::uint64_t own = of_checks + seed;
  if (region.placed)
    return check_placed(problem, region, variables, leg_ranges, {.samples = quick_samples, .seed = own}, control);
  const Look look = look_over(problem, region, {}, variables, {.samples = dense_samples, .seed = own}, control);
  RegionCheck out{std::exp(look.log_index), look.margin, look.excess, look.poses, {}};
  if (problem.objective.aggregate != Aggregate::worst)
    out.mean = region_mean(problem, region, mean_nodes(region, 1, own), variables, own, 0, control);
  return out;
}

}  // namespace ninedof
