#include "optimize/minimax/placed_pose.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear/eigenvectors.hpp"
#include "math/linear/jacobi_svd.hpp"
#include "math/linear/minimax_step.hpp"
#include "math/numbers.hpp"
#include "optimize/polish/cluster.hpp"
#include "optimize/region/posed.hpp"
#include "problem/constraints/solver_rows.hpp"

namespace ninedof {
namespace {

constexpr double largest_row = 700.0;   // replaces what is singular
constexpr double row_window = 0.3;          // rows farther below the largest are left out of a step
constexpr double longest_shift = 0.25;   // in zp
constexpr double first_curvature = 10.0;
constexpr double least_gain_of_step = 1e-12, least_decrease = 0.05, shortest_share = 1e-4;
constexpr int most_placing_steps = 60;
constexpr double row_rounding = 1e-15;
constexpr int most_cuts = 8;             // directions of singular vectors that join a step
constexpr double cut_passed = 1e-12;     // by which the index may pass the level of a step

/// The problem with one pose where s is a variable.
Problem with_free_point(const Problem& problem) {
  Problem out = with_one_pose(problem);
  out.objective.poses.front().best_internal = true;
  return out;
}

}  // namespace

PlacedPose::PlacedPose(const Problem& problem, const Eigen::VectorXd& variables, const PlacementGoal& goal)
    : goal_(goal),
      p_(with_free_point(problem)),
      specs_(p_.pose_specs),
      shift_variable_(specs_.at(1).offset),
      between_plates_(make_between_plates({0})) {
  none_ = selection_of(p_);
  const Index index = p_.problem.objective.index;
  has_directions_ = index == Index::condition_number || index == Index::speed;
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

void PlacedPose::set_pose(const Pose& pose, const std::optional<PoseSlopes>& slopes) {
  for (std::size_t k = 1; k < specs_.size(); ++k) {
    specs_[k].pose = pose;
    specs_[k].slopes = slopes;
  }
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
  if (!goal_.ranges[at_index(row.range)].spread.ratio) return margin;
  return share_of_limit(SolverMargin::logarithm, row.kind == Row::Kind::longest ? Side::high : Side::low, margin).value;
}

Vec3 PlacedPose::free_of(const Eigen::RowVectorXd& g) const {
  return {g[shift_variable_[0]], g[shift_variable_[1]], g[shift_variable_[2]]};
}

Vec3 PlacedPose::gradient(const Row& row) const {
  const PoseState& at = design_.state.pose(1);
  switch (row.kind) {
    case Row::Kind::index: return free_of(design_.row_gradient.row(row.item));
    case Row::Kind::limit: return -free_of(design_.margin_gradient.row(row.item));
    case Row::Kind::longest:
    case Row::Kind::shortest: {
      if (leg_ends(row.item).to != point_s) return Vec3::Zero();
      const LegRange& range = goal_.ranges[at_index(row.range)];
      const double by = range.spread.slope_over(std::max(at.legs.length[row.item], 1e-300), range.size);
      return (row.kind == Row::Kind::longest ? zp() : -zp()) / by * at.legs.direction[at_index(row.item)];
    }
    case Row::Kind::plates: {
      Eigen::RowVectorXd g = Eigen::RowVectorXd::Zero(design_.state.columns());
      between_plates_->add_gradient(design_.state, row.item, g);
      return -free_of(g);
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
    if (values_[k] >= least) near_.push_back({k});
}

void PlacedPose::turn_index_rows() {
  if (!has_directions_) return;
  for (Piece& piece : near_) {
    const Row& row = rows_[at_index(piece.row)];
    if (row.kind != Row::Kind::index) continue;
    const bool condition = p_.problem.objective.index == Index::condition_number;
    piece.row = -1;
    piece.top = Vec3::Unit(condition ? row.item / 3 : row.item);
    if (condition) piece.bottom = Vec3::Unit(row.item % 3);
  }
}

void PlacedPose::differentiate() {
  selection_.margins.clear();
  bool spectra = false, directions = false;
  for (const Piece& piece : near_) {
    directions |= piece.row < 0;
    if (piece.row < 0) continue;
    const Row& row = rows_[at_index(piece.row)];
    if (row.kind == Row::Kind::limit) selection_.margins.push_back(row.item);
    spectra |=
        row.kind == Row::Kind::index || (row.kind == Row::Kind::limit && p_.margins[at_index(row.item)].constraint < 0);
  }
  selection_.spectra.assign(at_index(p_.evaluated_spectra()), spectra);
  differentiate_rows(p_, design_, selection_);
  if (directions) {
    tops_ = cluster_block(design_, 0, {0, 1, 2});
    if (p_.problem.objective.index == Index::condition_number) bottoms_ = cluster_block(design_, 0, {5, 4, 3});
  }
  gradients_.resize(static_cast<Eigen::Index>(near_.size()), 3);
  for (std::size_t i = 0; i < near_.size(); ++i)
    gradients_.row(static_cast<Eigen::Index>(i)) = gradient(near_[i]).transpose();
}

Eigen::RowVectorXd PlacedPose::along(const Piece& piece) const {
  Eigen::RowVectorXd out = Eigen::RowVectorXd::Zero(design_.state.columns());
  std::size_t entry = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j, ++entry) {
      const double twice = i == j ? 1.0 : 2.0;
      if (const double w = twice * piece.top[i] * piece.top[j]; w != 0.0) out += w * tops_[entry];
      if (const double w = twice * piece.bottom[i] * piece.bottom[j]; w != 0.0) out -= w * bottoms_[entry];
    }
  return out;
}

Vec3 PlacedPose::gradient(const Piece& piece) const {
  return piece.row < 0 ? free_of(along(piece)) : gradient(rows_[at_index(piece.row)]);
}

double PlacedPose::value(const Piece& piece) const {
  if (piece.row >= 0) return values_[piece.row];
  const Vec6& log_sigma = design_.spectra.front().log_sigma;
  double out = -goal_.log_index;
  for (int k = 0; k < 3; ++k) out += square(piece.top[k]) * log_sigma[k] - square(piece.bottom[k]) * log_sigma[5 - k];
  return out;
}

PlacedPose::Piece PlacedPose::steepest(const Vec3& step) const {
  const Vec6& log_sigma = design_.spectra.front().log_sigma;
  const auto matrix = [&](const std::vector<Eigen::RowVectorXd>& block, bool top) {
    Eigen::MatrixXd out(3, 3);
    std::size_t entry = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        out(i, j) = out(j, i) = free_of(block[entry++]).dot(step) + (i == j ? log_sigma[top ? i : 5 - i] : 0.0);
    return out;
  };
  Piece out{-1, symmetric_eigen(-matrix(tops_, true)).vectors.col(0)};
  if (p_.problem.objective.index == Index::condition_number)
    out.bottom = symmetric_eigen(matrix(bottoms_, false)).vectors.col(0);
  return out;
}

MinimaxStep PlacedPose::least_step(const Mat3& curvature) {
  Eigen::VectorXd f(static_cast<Eigen::Index>(near_.size()));
  for (std::size_t i = 0; i < near_.size(); ++i) f[static_cast<Eigen::Index>(i)] = value(near_[i]);
  MinimaxStep out = minimax_step(f, gradients_, curvature);
  const bool directions = std::ranges::any_of(near_, [](const Piece& piece) { return piece.row < 0; });
  for (int cut = 0; directions && cut < most_cuts; ++cut) {
    const Piece piece = steepest(out.step);
    const double at_start = value(piece);
    const Vec3 slope = gradient(piece);
    if (!(at_start + slope.dot(out.step) > out.level + cut_passed)) break;
    const Eigen::Index n = f.size();
    near_.push_back(piece);
    f.conservativeResize(n + 1);
    f[n] = at_start;
    gradients_.conservativeResize(n + 1, 3);
    gradients_.row(n) = slope.transpose();
    out = minimax_step(f, gradients_, curvature);
  }
  return out;
}

Mat6 PlacedPose::vectors() const {
  return design_.spectra.front().general.twist;
}

void PlacedPose::carry(std::vector<Piece>& pieces, const Mat6& from) const {
  const Mat6 overlap = vectors().transpose() * from;
  const Mat3 top = nearest_orthogonal(overlap.topLeftCorner<3, 3>());
  const Mat3 bottom = nearest_orthogonal(overlap.bottomRightCorner<3, 3>().reverse());
  for (Piece& piece : pieces) {
    if (piece.row >= 0) continue;
    piece.top = top * piece.top;
    piece.bottom = bottom * piece.bottom;
  }
}

double PlacedPose::place(Vec3& shift, double enough) {
  double worst = evaluate(shift);
  if (!(worst < largest_row)) return worst;
  Mat3 curvature = first_curvature * Mat3::Identity();
  std::vector<Piece> last;  // of the step before, with their weights and gradients
  Eigen::VectorXd last_weight;
  Gradient last_gradient;
  Vec3 moved = Vec3::Zero();
  Mat6 last_vectors = Mat6::Zero();
  for (int k = 0; k < most_placing_steps && worst > enough; ++k) {
    select(worst - row_window);
    turn_index_rows();
    // Pieces of the last step are needed for the curvature of what held with equality.
    const auto first = static_cast<Eigen::Index>(near_.size());
    if (has_directions_ && !last.empty()) carry(last, last_vectors);
    near_.insert(near_.end(), last.begin(), last.end());
    differentiate();
    if (!last.empty()) {
      const Vec3 bend = (gradients_.bottomRows(gradients_.rows() - first) - last_gradient).transpose() * last_weight;
      // Damped, so that it stays positive definite (Powell).
      const Vec3 pull = curvature * moved;
      const double along = moved.dot(pull), met = moved.dot(bend);
      if (along > 1e-300) {
        const double theta = met >= 0.2 * along ? 1.0 : 0.8 * along / (along - met);
        const Vec3 y = theta * bend + (1.0 - theta) * pull;
        curvature += y * y.transpose() / moved.dot(y) - pull * pull.transpose() / along;
      }
    }
    const MinimaxStep step = least_step(curvature);
    const double predicted = worst - step.level;
    if (!(predicted > least_gain_of_step) || !step.step.allFinite()) {
      // The value is there, the slopes not yet: one more step takes them from the root of that gain to zero.
      if (predicted > 0.0 && step.step.allFinite() && evaluate(shift + step.step) <= worst + row_rounding)
        shift += step.step;
      worst = evaluate(shift);
      break;
    }
    last.clear();
    std::vector<Eigen::Index> carrying;
    for (Eigen::Index i = 0; i < step.weight.size(); ++i)
      if (step.weight[i] > 0.0) {
        carrying.push_back(i);
        last.push_back(near_[at_index(i)]);
      }
    last_weight = step.weight(carrying);
    last_gradient = gradients_(carrying, Eigen::all);
    if (has_directions_) last_vectors = vectors();
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
  const Eigen::Index legs = 9 * static_cast<Eigen::Index>(goal_.ranges.size());
  return {Eigen::VectorXd::Zero(rows), Rows::Zero(rows, own()), Rows::Zero(rows, legs), Eigen::VectorXd::Zero(rows),
          Rows::Zero(rows, design_.state.columns() - own() - 3)};
}

void PlacedPose::add_outer(const Row& row, double weight, Eigen::Index k, Outer& out) {
  Eigen::RowVectorXd g = Eigen::RowVectorXd::Zero(design_.state.columns());
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
      state.add_leg(1, row.item, sign / range.spread.slope_over(length, range.size), g);
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
  out.by_variables.row(k) += weight * g.head(own());
  out.by_at.row(k) += weight * g.tail(out.by_at.cols());
}

PlacedPose::Outer PlacedPose::least(const Vec3& shift) {
  const double worst = evaluate(shift);
  Outer out = empty(1);
  out.value[0] = worst;
  select(worst - row_window);
  turn_index_rows();
  differentiate();
  // By the envelope theorem the shift of s may be held.
  const MinimaxStep step = least_step(first_curvature * Mat3::Identity());
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const double w = step.weight[static_cast<Eigen::Index>(i)];
    if (!(w > 0.0)) continue;
    const Piece& piece = near_[i];
    if (piece.row >= 0) {
      add_outer(rows_[at_index(piece.row)], w, 0, out);
      continue;
    }
    const Eigen::RowVectorXd g = along(piece);
    out.by_index[0] -= w;
    out.by_variables.row(0) += w * g.head(own());
    out.by_at.row(0) += w * g.tail(out.by_at.cols());
  }
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
