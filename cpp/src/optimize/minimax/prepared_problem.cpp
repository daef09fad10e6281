#include "optimize/minimax/prepared_problem.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "math/sort_by.hpp"
#include "optimize/minimax/design_evaluation.hpp"
#include "problem/constraints/length_joint.hpp"

namespace ninedof {
namespace {

/// Number of unrelated designs. What holds in all of them is taken to hold in every design.
constexpr int probes = 3;

/// Difference of margins that counts as none.
double same_margin(double margin) {
  return 1e-11 * std::max(1.0, std::abs(margin));
}

/// Relative difference of distances that tie for the characteristic length.
constexpr double same_distance = 1e-6;

const std::string condition_limit_name = "condition_limit", neutral_condition_limit_name = "condition_limit at neutral";

int count_auxiliary(const Problem& problem) {
  int count = 0;
  for (const Limit& limit : problem.limits)
    count += make_solver_rows(limit, static_cast<int>(problem.objective.poses.size()), Purpose::solve, {})
                 ->auxiliary_count();
  return count;
}

}  // namespace

PreparedProblem::PreparedProblem(const Problem& given, double size_limit)
    : PreparedProblem(given, Coordinates(given, size_limit, count_auxiliary(given)), Purpose::solve) {
  drop_repeated_margins();
}

PreparedProblem::PreparedProblem(const Problem& given)
    : PreparedProblem(given, Coordinates::plain(given), Purpose::evaluate) {}

PreparedProblem::PreparedProblem(const Problem& given, const Eigen::VectorXd& variables)
    : PreparedProblem(given, Coordinates::fixed(given, variables), Purpose::evaluate) {}

PreparedProblem::PreparedProblem(const Problem& given, Coordinates solved, Purpose purpose)
    : problem(given),
      family(&design_family(given.family)),
      coordinates(std::move(solved)),
      pose_specs(ninedof::pose_specs(given, coordinates)),
      objective_poses(static_cast<int>(given.objective.poses.size())) {
  const Objective& o = problem.objective;
  const int poses = evaluated_poses();
  for (int k = 0; k < poses; ++k) {
    const PoseSpec& spec = pose_specs[at_index(objective_poses > 0 ? k + 1 : 0)];
    closed.push_back(on_axis(problem, spec.pose));
    first_row_.push_back(rows);
    rows += index_rows(o.index, closed.back());
  }
  first_row_.push_back(rows);
  const bool single = o.aggregate == Aggregate::worst || poses == 1;
  const bool weighted = !single && o.aggregate == Aggregate::weighted;
  std::vector<int> level_of(at_index(poses), single ? 0 : -1);
  std::vector<double> weights;
  for (int k = 0; k < poses && !single; ++k) {
    const double weight = o.poses[at_index(k)].weight;
    if (weight == 0.0) continue;
    level_of[at_index(k)] = static_cast<int>(weights.size());
    weights.push_back(weight);
  }
  mean_weights = Eigen::VectorXd::Map(weights.data(), static_cast<Eigen::Index>(weights.size()));
  levels = single ? 1 : static_cast<int>(weights.size()) + weighted;
  for (int k = 0; k < poses; ++k)
    for (int row = first_row(k); row < first_row(k + 1); ++row) {
      if (level_of[at_index(k)] >= 0) row_levels.push_back({row, level_of[at_index(k)]});
      if (weighted) row_levels.push_back({row, levels - 1});
    }
  const auto full = static_cast<int>(full_variables(problem).size());
  const auto of_pairs = [](const Limit& l) {
    const PoseRow* row = limit_row(l.name).pose;
    return row != nullptr && row->pairs;
  };
  const bool pairs = std::ranges::any_of(problem.limits, of_pairs);
  const std::array<bool, leg_pairs> exempt = pairs ? exempt_pairs(problem) : std::array<bool, leg_pairs>{};
  for (const Limit& limit : problem.limits) {
    constraints.push_back(make_solver_rows(limit, objective_poses, purpose, exempt));
    const int own = constraints.back()->auxiliary_count();
    if (own > 0)
      constraints.back()->set_auxiliary(full + auxiliary_count, coordinates.coordinate(full + auxiliary_count));
    auxiliary_count += own;
  }
  std::vector<int> optimized_points;
  for (int k = 0; k < objective_poses; ++k)
    if (optimizes_internal_point(problem.objective.poses[at_index(k)])) optimized_points.push_back(k);
  if (purpose == Purpose::solve && !optimized_points.empty())
    constraints.push_back(make_between_plates(std::move(optimized_points)));
  const StudyLength& length = problem.characteristic_length;
  if (purpose == Purpose::solve && length.choice == StudyLength::Choice::kind &&
      length.kind == LengthKind::platform_radius) {
    length_joints = joints_of_distinct_distance(unrelated_designs(coordinates));
    if (length_joints.size() > 1) constraints.push_back(make_length_joint(length_joints));
    else length_joints.clear();
  }
  for (std::size_t k = 0; k < constraints.size(); ++k)
    for (int row = 0; row < constraints[k]->rows(); ++row) margins.push_back({static_cast<int>(k), row});
  if (std::isfinite(o.neutral_condition_limit)) closed.push_back(on_axis(problem, pose_specs.front().pose));
  for (int k = 0; k < evaluated_spectra(); ++k)
    if (std::isfinite(condition_limit(k)))
      for (int pair = 0; pair < index_rows(Index::condition_number, closed[at_index(k)]); ++pair)
        margins.push_back({-1 - k, pair});
}

std::vector<DesignState> PreparedProblem::unrelated_designs(const Coordinates& within) const {
  std::vector<DesignState> designs(probes);
  for (int k = 0; k < probes; ++k)
    designs[at_index(k)].set(*family, problem, within, {{}}, 0, within.start(7 * k + 1, 12345));
  return designs;
}

void PreparedProblem::drop_repeated_margins() {
  // Symmetry makes many margins the same function; these agree at a few unrelated designs.
  std::vector<Eigen::VectorXd> probed;
  DesignEvaluation design;
  const RowSelection none = selection_of(*this);
  for (int k = 0; k < probes; ++k) {
    // Offsets of s and auxiliary variables take unrelated values, so that margins do not agree by chance.
    Eigen::VectorXd y = coordinates.start(7 * k + 1, 12345);
    for (int v = 0; v < coordinates.size(); ++v)
      if (coordinates.info(v).internal_bounds && coordinates.info(v).kind == VariableKind::fraction)
        y[v] = 0.01 * std::sin(1.0 + 3.0 * v + 7.0 * k);
    evaluate_design(*this, y, design, &none);
    probed.push_back(design.margins);
  }
  const auto same = [&](std::size_t a, std::size_t b) {
    return std::ranges::all_of(probed, [&](const Eigen::VectorXd& m) {
      const double x = m[static_cast<Eigen::Index>(a)], y = m[static_cast<Eigen::Index>(b)];
      return std::abs(x - y) <= same_margin(x) && x > worst_margin;
    });
  };
  std::vector<MarginRow> kept;
  // Those kept of each constraint, by their margin at the first design: of a hundred thousand only few can be equal.
  std::map<int, std::multimap<double, std::size_t>> kept_of;
  for (std::size_t k = 0; k < margins.size(); ++k) {
    const int constraint = margins[k].constraint;
    const bool analytic = constraint < 0 || constraints[at_index(constraint)]->analytic();
    auto& others = kept_of[constraint];
    const double m = probed.front()[static_cast<Eigen::Index>(k)], width = 2.0 * same_margin(m);
    const auto last = others.upper_bound(m + width);
    const bool repeated =
        analytic && m > worst_margin &&
        std::any_of(others.lower_bound(m - width), last, [&](const auto& other) { return same(other.second, k); });
    if (repeated) continue;
    kept.push_back(margins[k]);
    others.emplace(m, k);
  }
  margins = std::move(kept);
}

const std::string& PreparedProblem::margin_name(int k) const {
  const int constraint = margins[at_index(k)].constraint;
  if (constraint >= 0) return constraints[at_index(constraint)]->label();
  return -1 - constraint < evaluated_poses() ? condition_limit_name : neutral_condition_limit_name;
}

bool PreparedProblem::has_kinks() const {
  const Index index = problem.objective.index;
  return (index == Index::condition_number || index == Index::speed) &&
         std::ranges::find(closed, false) != closed.end();
}

int PreparedProblem::objective_pose(int state_pose) const {
  if (state_pose <= objective_poses) return state_pose - 1;
  const int between = (static_cast<int>(pose_specs.size()) - 1 - objective_poses) / objective_poses;
  return (state_pose - 1 - objective_poses) / between;
}

int PreparedProblem::pose_of(int row) const {
  const auto next = std::ranges::upper_bound(first_row_, row);
  return static_cast<int>(next - first_row_.begin()) - 1;
}

double PreparedProblem::margin_price(int k) const {
  const auto [constraint, row] = margins[at_index(k)];
  return constraint < 0 ? 1.0 : constraints[at_index(constraint)]->price_factor(row);
}

ShownMargin PreparedProblem::shown_margin(int k, double margin) const {
  const auto [constraint, row] = margins[at_index(k)];
  return constraint < 0 ? share_of_limit(SolverMargin::logarithm, Side::high, margin)
                        : constraints[at_index(constraint)]->shown(row, margin);
}

double PreparedProblem::limited_value(int k, double margin) const {
  const auto [constraint, row] = margins[at_index(k)];
  if (constraint < 0) return condition_limit(-1 - constraint) * std::exp(-margin);
  const SolverRows& c = *constraints[at_index(constraint)];
  return c.value_at(c.side_of(row), margin);
}

std::string PreparedProblem::margin_part(int k) const {
  const auto [constraint, row] = margins[at_index(k)];
  return constraint < 0 ? "" : constraints[at_index(constraint)]->part_of(row);
}

double PreparedProblem::violation_factor(int k) const {
  const auto [constraint, row] = margins[at_index(k)];
  return constraint < 0 ? 1.0 : constraints[at_index(constraint)]->violation_factor(row);
}

bool PreparedProblem::follow(int pose, const std::shared_ptr<const FollowingPose>& how) {
  if (closed[at_index(pose)]) return false;
  for (std::size_t k = 1; k < pose_specs.size(); ++k)
    if (objective_pose(static_cast<int>(k)) == pose) pose_specs[k].follows = how;
  return true;
}

void PreparedProblem::set_state(const Eigen::VectorXd& y, DesignState& state) const {
  state.set(*family, problem, coordinates, pose_specs, objective_poses, y);
  state.unit = problem.unit();
}

std::vector<int> PreparedProblem::pieces(const Eigen::VectorXd& y) const {
  if (length_joints.empty()) return {-1};
  DesignState state;
  set_state(y, state);
  std::vector<int> out = length_joints;
  sort_by(out, [&](int joint) { return -state.joint_distance(joint); });
  const double least = state.joint_distance(out.front()) * (1.0 - same_distance);
  std::erase_if(out, [&](int joint) { return state.joint_distance(joint) < least; });
  return out;
}

Eigen::VectorXd PreparedProblem::with_auxiliary(const Eigen::VectorXd& y) const {
  if (auxiliary_count == 0) return y;
  DesignState state;
  set_state(y, state);
  Eigen::VectorXd x = state.x;
  for (const auto& c : constraints)
    for (int k = 0; k < c->auxiliary_count(); ++k) x[c->auxiliary_variable() + k] = c->auxiliary_value(state, k);
  return coordinates.coordinates(x);
}

double PreparedProblem::objective(const Eigen::VectorXd& t, Eigen::VectorXd* slopes) const {
  if (levels == 1) {
    if (slopes != nullptr) slopes->setOnes(1);
    return t[0];
  }
  const Objective& o = problem.objective;
  const Eigen::Index poses = mean_weights.size();
  const double least = t.head(poses).minCoeff();
  const Eigen::VectorXd share = mean_weights.array() * (least - t.head(poses).array()).exp();
  const double sum = share.sum();
  const double mean = least - std::log(sum / mean_weights.sum());  // -log of the mean of exp(-t)
  const double w = o.aggregate == Aggregate::weighted ? o.weight : 0.0;
  if (slopes != nullptr) {
    slopes->resize(levels);
    slopes->head(poses) = (1.0 - w) / sum * share;
    if (levels > poses) (*slopes)[poses] = w;
  }
  return (1.0 - w) * mean + (levels > poses ? w * t[poses] : 0.0);
}

}  // namespace ninedof
