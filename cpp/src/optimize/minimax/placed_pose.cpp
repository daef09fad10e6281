#include "optimize/minimax/placed_pose.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear/minimax_step.hpp"
#include "math/numbers.hpp"
#include "problem/constraints/constraint.hpp"

namespace ninedof {
namespace {

constexpr double largest_row = 700.0;   // replaces what is singular
constexpr double row_window = 0.3;          // rows farther below the largest are left out of a step
constexpr double longest_shift = 0.25;   // in zp
constexpr double first_curvature = 10.0;
constexpr double least_gain_of_step = 1e-12, least_decrease = 0.05, shortest_share = 1e-4;
constexpr int most_placing_steps = 60;

/// The problem with one pose where s is a variable, off the axis so that the closed form is not used.
Problem with_free_point(Problem problem) {
  problem.objective.aggregate = Aggregate::worst;
  problem.objective.poses = {{}};
  problem.objective.poses.front().position = Vec3(1.0, 0.5, 0.0);
  problem.objective.poses.front().best_internal = true;
  return problem;
}

}  // namespace

PlacedPose::PlacedPose(const Problem& problem, const Eigen::VectorXd& variables, const PlacementGoal& goal)
    : goal_(goal),
      p_(with_free_point(problem)),
      specs_(p_.pose_specs),
      shift_variable_(specs_.at(1).offset),
      between_plates_(make_between_plates({0})) {
  none_.spectra.assign(at_index(p_.evaluated_spectra()), false);
  list_rows(variables);
}

void PlacedPose::list_rows(const Eigen::VectorXd& variables) {
  set_design(variables);
  for (int k = 0; k < p_.rows; ++k) rows_.push_back({Row::Kind::index, k, 0});
  // Limits of the design alone are the same everywhere.
  std::vector<Eigen::VectorXd> probed;
  for (const double t : {0.03, -0.05, 0.08}) {
    Pose pose;
    pose.position = t * zp() * Vec3(1.0, -0.7, 0.4);
    pose.rotation = t * Vec3(0.6, 1.0, -0.8);
    set_pose(pose);
    for (const int v : shift_variable_) design_.state.x[v] = 0.3 * t;
    design_.state.set_poses(specs_);
    evaluate_rows(p_, design_, &none_);
    probed.push_back(design_.margins);
  }
  for (Eigen::Index k = 0; k < probed.front().size(); ++k) {
    const bool moves = probed[0][k] != probed[1][k] || probed[0][k] != probed[2][k];
    const auto item = static_cast<int>(k);
    const std::string& name = p_.margin_name(item);
    // For limits of the lengths over all poses the goal has ranges.
    if (const int c = p_.margins[at_index(k)].constraint; c >= 0 && p_.constraints[at_index(c)]->compares_poses())
      continue;
    (moves && !name.ends_with(" at neutral") ? rows_ : of_design_).push_back({Row::Kind::limit, item, 0});
  }
  first_of_range_ = static_cast<int>(rows_.size());
  for (std::size_t range = 0; range < goal_.ranges.size(); ++range)
    for (int leg = 0; leg < 9; ++leg)
      for (const auto kind : {Row::Kind::longest, Row::Kind::shortest})
        rows_.push_back({kind, leg, static_cast<int>(range)});
  for (int plate = 0; plate < between_plates_->rows(); ++plate) rows_.push_back({Row::Kind::plates, plate, 0});
  for (int axis = 0; axis < 3; ++axis) rows_.push_back({Row::Kind::box, axis, 0});
  values_.resize(static_cast<Eigen::Index>(rows_.size()));
}

void PlacedPose::set_design(const Eigen::VectorXd& variables) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(variables.size() + 3);
  x.head(variables.size()) = variables;
  p_.set_state(x, design_.state);
}

void PlacedPose::set_pose(const Pose& pose) {
  for (std::size_t k = 1; k < specs_.size(); ++k) specs_[k].pose = pose;
}

double PlacedPose::value(const Row& row) const {
  const PoseState& at = design_.state.pose(1);
  const LegRange* range = goal_.ranges.empty() ? nullptr : &goal_.ranges[at_index(row.range)];
  switch (row.kind) {
    case Row::Kind::index: return design_.objective_rows[row.item] - goal_.log_index;
    case Row::Kind::limit: return -design_.margins[row.item];
    case Row::Kind::longest: return range->measured(at.legs.length[row.item]) - range->high[row.item];
    case Row::Kind::shortest: return range->low[row.item] - range->measured(at.legs.length[row.item]);
    case Row::Kind::plates: return -between_plates_->margin(design_.state, row.item);
    case Row::Kind::box: return std::abs(design_.state.x[shift_variable_[at_index(row.item)]]) - 1.0;
  }
  return largest_row;
}

double PlacedPose::shown_margin(const Row& row, double margin) const {
  if (row.kind == Row::Kind::limit) return p_.shown_margin(row.item, margin).value;
  if (!goal_.ranges[at_index(row.range)].logarithm) return margin;
  return share_of_limit(row.kind == Row::Kind::longest ? Side::high : Side::low, margin).value;
}

Vec3 PlacedPose::gradient(const Row& row) const {
  const PoseState& at = design_.state.pose(1);
  const auto free = [&](const auto& gradients) {
    Vec3 out;
    for (int axis = 0; axis < 3; ++axis) out[axis] = gradients(row.item, shift_variable_[at_index(axis)]);
    return out;
  };
  switch (row.kind) {
    case Row::Kind::index: return free(design_.row_gradient);
    case Row::Kind::limit: return -free(design_.margin_gradient);
    case Row::Kind::longest:
    case Row::Kind::shortest: {
      if (leg_ends(row.item).to != point_s) return Vec3::Zero();
      const LegRange& range = goal_.ranges[at_index(row.range)];
      const double by = range.logarithm ? std::max(at.legs.length[row.item], 1e-300) : range.size;
      return (row.kind == Row::Kind::longest ? zp() : -zp()) / by * at.legs.direction[at_index(row.item)];
    }
    case Row::Kind::plates: {
      Eigen::RowVectorXd g = Eigen::RowVectorXd::Zero(design_.state.columns());
      between_plates_->add_gradient(design_.state, row.item, g);
      return -Vec3(g[shift_variable_[0]], g[shift_variable_[1]], g[shift_variable_[2]]);
    }
    case Row::Kind::box:
      return design_.state.x[shift_variable_[at_index(row.item)]] < 0.0 ? Vec3(-Vec3::Unit(row.item))
                                                                        : Vec3(Vec3::Unit(row.item));
  }
  return Vec3::Zero();
}

double PlacedPose::evaluate(const Vec3& shift) {
  for (int axis = 0; axis < 3; ++axis) design_.state.x[shift_variable_[at_index(axis)]] = shift[axis];
  design_.state.set_poses(specs_);
  evaluate_rows(p_, design_, &none_);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const double v = value(rows_[k]);
    values_[static_cast<Eigen::Index>(k)] = v < largest_row ? v : largest_row;
  }
  return values_.maxCoeff();
}

void PlacedPose::select(double least) {
  near_.clear();
  for (Eigen::Index k = 0; k < values_.size(); ++k)
    if (values_[k] >= least) near_.push_back(k);
}

void PlacedPose::differentiate() {
  selection_.margins.clear();
  bool spectra = false;
  for (const Eigen::Index k : near_) {
    const Row& row = rows_[at_index(k)];
    if (row.kind == Row::Kind::limit) selection_.margins.push_back(row.item);
    spectra |=
        row.kind == Row::Kind::index || (row.kind == Row::Kind::limit && p_.margins[at_index(row.item)].constraint < 0);
  }
  selection_.spectra.assign(at_index(p_.evaluated_spectra()), spectra);
  evaluate_rows(p_, design_, &selection_);
  gradients_.resize(static_cast<Eigen::Index>(near_.size()), 3);
  for (std::size_t i = 0; i < near_.size(); ++i)
    gradients_.row(static_cast<Eigen::Index>(i)) = gradient(rows_[at_index(near_[i])]).transpose();
}

double PlacedPose::place(Vec3& shift, double enough) {
  double worst = evaluate(shift);
  if (!(worst < largest_row)) return worst;
  Mat3 curvature = first_curvature * Mat3::Identity();
  std::vector<Eigen::Index> last_rows;  // of the step before, with their weights and gradients
  Eigen::VectorXd last_weight;
  Gradient last_gradient;
  Vec3 moved = Vec3::Zero();
  for (int k = 0; k < most_placing_steps && worst > enough; ++k) {
    select(worst - row_window);
    // Rows of the last step are needed for the curvature of what held with equality.
    for (const Eigen::Index row : last_rows)
      if (std::ranges::find(near_, row) == near_.end()) near_.push_back(row);
    std::ranges::sort(near_);
    differentiate();
    if (!last_rows.empty()) {
      Vec3 bend = Vec3::Zero();
      for (std::size_t i = 0; i < last_rows.size(); ++i) {
        const auto here = std::ranges::find(near_, last_rows[i]) - near_.begin();
        const auto n = static_cast<Eigen::Index>(i);
        bend += last_weight[n] * (gradients_.row(here) - last_gradient.row(n)).transpose();
      }
      // Damped, so that it stays positive definite (Powell).
      const Vec3 pull = curvature * moved;
      const double along = moved.dot(pull), met = moved.dot(bend);
      if (along > 1e-300) {
        const double theta = met >= 0.2 * along ? 1.0 : 0.8 * along / (along - met);
        const Vec3 y = theta * bend + (1.0 - theta) * pull;
        curvature += y * y.transpose() / moved.dot(y) - pull * pull.transpose() / along;
      }
    }
    Eigen::VectorXd f(static_cast<Eigen::Index>(near_.size()));
    for (std::size_t i = 0; i < near_.size(); ++i) f[static_cast<Eigen::Index>(i)] = values_[near_[i]];
    const MinimaxStep step = minimax_step(f, gradients_, curvature);
    const double predicted = worst - step.level;
    if (!(predicted > least_gain_of_step) || !step.step.allFinite()) break;
    double share = std::min(1.0, longest_shift / std::max(step.step.norm(), 1e-300));
    double next = infinity;
    for (; share >= shortest_share; share *= 0.5) {
      next = evaluate(shift + share * step.step);
      if (next <= worst - least_decrease * share * predicted) break;
    }
    if (!(next < worst)) {
      evaluate(shift);
      break;
    }
    moved = share * step.step;
    shift += moved;
    worst = next;
    last_rows.clear();
    std::vector<double> weights;
    for (std::size_t i = 0; i < near_.size(); ++i)
      if (const double w = step.weight[static_cast<Eigen::Index>(i)]; w > 0.0) {
        weights.push_back(w);
        last_rows.push_back(near_[i]);
        last_gradient.conservativeResize(static_cast<Eigen::Index>(weights.size()), 3);
        last_gradient.row(static_cast<Eigen::Index>(weights.size()) - 1) = gradients_.row(static_cast<Eigen::Index>(i));
      }
    last_weight = Eigen::VectorXd::Map(weights.data(), static_cast<Eigen::Index>(weights.size()));
  }
  return worst;
}

PlacedRows PlacedPose::rows(const Vec3& shift) {
  evaluate(shift);
  select(-infinity);
  differentiate();
  return {values_, gradients_, p_.rows, first_of_range_};
}

PlacedEnd PlacedPose::end(const Placed& placed) {
  PlacedEnd out{placed, evaluate(placed.shift), -infinity, infinity, ""};
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Row& row = rows_[k];
    const double v = values_[static_cast<Eigen::Index>(k)];
    if (row.kind == Row::Kind::index) out.log_index = std::max(out.log_index, v + goal_.log_index);
    if (row.kind == Row::Kind::index || row.kind > Row::Kind::shortest) continue;
    if (const double margin = shown_margin(row, -v); margin < out.margin) {
      out.margin = margin;
      out.limit = row.kind == Row::Kind::limit ? p_.margin_name(row.item) : goal_.ranges[at_index(row.range)].limit;
    }
  }
  return out;
}

PlacedPose::Outer PlacedPose::empty(Eigen::Index rows) const {
  const Eigen::Index own = design_.state.columns() - 3, legs = 9 * static_cast<Eigen::Index>(goal_.ranges.size());
  return {Eigen::VectorXd::Zero(rows), Rows::Zero(rows, own), Rows::Zero(rows, legs), Eigen::VectorXd::Zero(rows)};
}

void PlacedPose::add_outer(const Row& row, double weight, Eigen::Index k, Outer& out) {
  const Eigen::Index own = out.by_variables.cols();
  Eigen::RowVectorXd g = Eigen::RowVectorXd::Zero(own + 3);
  DesignState& state = design_.state;
  const PoseState& at = state.pose(1);
  switch (row.kind) {
    case Row::Kind::index:
      g = design_.row_gradient.row(row.item);
      out.by_index[k] -= weight;
      break;
    case Row::Kind::limit: g = -design_.margin_gradient.row(row.item); break;
    case Row::Kind::longest:
    case Row::Kind::shortest: {
      const LegRange& range = goal_.ranges[at_index(row.range)];
      const double sign = row.kind == Row::Kind::longest ? 1.0 : -1.0, length = at.legs.length[row.item];
      state.add_leg(1, row.item, sign / (range.logarithm ? length : range.size), g);
      if (range.in_zp) state.add_zp(-sign * length / (range.size * zp()), g);
      out.by_ranges(k, 9 * row.range + row.item) -= sign * weight;
      break;
    }
    case Row::Kind::plates:
      between_plates_->add_gradient(state, row.item, g);
      g = -g;
      break;
    case Row::Kind::box: break;
  }
  out.by_variables.row(k) += weight * g.head(own);
}

PlacedPose::Outer PlacedPose::least(const Vec3& shift) {
  const double worst = evaluate(shift);
  Outer out = empty(1);
  out.value[0] = worst;
  select(worst - row_window);
  differentiate();
  Eigen::VectorXd f(static_cast<Eigen::Index>(near_.size()));
  for (std::size_t i = 0; i < near_.size(); ++i) f[static_cast<Eigen::Index>(i)] = values_[near_[i]];
  // By the envelope theorem the shift of s may be held.
  const MinimaxStep step = minimax_step(f, gradients_, first_curvature * Mat3::Identity());
  for (std::size_t i = 0; i < near_.size(); ++i)
    if (const double w = step.weight[static_cast<Eigen::Index>(i)]; w > 0.0)
      add_outer(rows_[at_index(near_[i])], w, 0, out);
  return out;
}

PlacedPose::Outer PlacedPose::all(const Vec3& shift) {
  evaluate(shift);
  select(-infinity);
  differentiate();
  Outer out = empty(values_.size());
  out.value = values_;
  for (Eigen::Index k = 0; k < values_.size(); ++k) add_outer(rows_[at_index(k)], 1.0, k, out);
  return out;
}

PlacedPose::Outer PlacedPose::of_design() {
  selection_.margins.clear();
  for (const Row& row : of_design_) selection_.margins.push_back(row.item);
  selection_.spectra.assign(at_index(p_.evaluated_spectra()), true);
  evaluate_rows(p_, design_, &selection_);
  Outer out = empty(static_cast<Eigen::Index>(of_design_.size()));
  for (std::size_t k = 0; k < of_design_.size(); ++k) {
    out.value[static_cast<Eigen::Index>(k)] = -design_.margins[of_design_[k].item];
    add_outer(of_design_[k], 1.0, static_cast<Eigen::Index>(k), out);
  }
  return out;
}

}  // namespace ninedof
