/// Declared in optimize/polish/active_set.hpp.

#include <algorithm>

#include "math/linear/least_squares.hpp"
#include "optimize/polish/active_set.hpp"
#include "optimize/polish/cluster.hpp"

namespace ninedof {
namespace {

constexpr int newton_steps = 6;
constexpr double difference_step = 1e-6;  // of solver coordinates, which are of order one

/// Values and derivatives of the equations; each value equals t of its `level`, or 0 where that is -1.
struct Equations {
  Eigen::VectorXd value;
  Eigen::MatrixXd gradient;  ///< one row each, by free coordinate
  std::vector<int> level;
};

/// The equations of an active set: rows equal to their level, margins at zero, singular values that coincide.
class ActiveEquations {
 public:
  ActiveEquations(const PreparedProblem& p, const DesignEvaluation& design, const ActiveSet& a, double gap)
      : p_(&p), margins_(a.margins) {
    std::vector<int> poses;
    for (const int k : a.row_levels) {
      const int pose = p.pose_of(p.row_levels[at_index(k)].row);
      if (std::ranges::find(poses, pose) == poses.end()) poses.push_back(pose);
    }
    if (gap > 0.0) groups_ = coalesced_groups(p, design, poses, gap);
    for (const int k : a.row_levels) {
      const RowLevel& u = p.row_levels[at_index(k)];
      const int pose = p.pose_of(u.row);
      const bool held = std::ranges::any_of(groups_, [&](const Coalesced& c) { return c.pose() == pose; });
      if (!held) {
        plain_.push_back(k);
        continue;
      }
      const bool known =
          std::ranges::any_of(pose_levels_, [&](const PoseLevel& r) { return r.pose == pose && r.level == u.level; });
      if (!known) pose_levels_.push_back({pose, u.level});
    }
  }

  Equations at(const DesignEvaluation& design) const {
    std::size_t structure = 0;  // equations that say singular values coincide
    for (const Coalesced& c : groups_) structure += at_index(c.size() * (c.size() + 1) / 2 - 1);
    const auto count = static_cast<Eigen::Index>(plain_.size() + margins_.size() + pose_levels_.size() + structure);
    Equations out{Eigen::VectorXd(count), Eigen::MatrixXd(count, design.state.columns()), {}};
    Eigen::Index row = 0;
    const auto add = [&](double value, const Eigen::RowVectorXd& gradient, int level) {
      out.value[row] = value;
      out.gradient.row(row++) = gradient;
      out.level.push_back(level);
    };
    for (const int k : plain_) {
      const RowLevel& u = p_->row_levels[at_index(k)];
      add(design.objective_rows[u.row], design.row_gradient.row(u.row), u.level);
    }
    for (const int k : margins_) add(design.margins[k], design.margin_gradient.row(k), -1);
    std::vector<Coalesced::Entries> entries;
    for (const Coalesced& c : groups_) entries.push_back(c.at(design));
    for (const PoseLevel& r : pose_levels_) {
      // The largest less the smallest singular value, each the mean of its group where it is held equal.
      const PoseSpectrum& s = design.spectra[at_index(r.pose)];
      double top = s.log_sigma[0], bottom = s.log_sigma[5];
      Eigen::RowVectorXd top_gradient = s.gradient.row(0), bottom_gradient = s.gradient.row(5);
      for (std::size_t k = 0; k < groups_.size(); ++k) {
        if (groups_[k].pose() != r.pose) continue;
        const Coalesced::Entries& e = entries[k];
        const Coalesced& c = groups_[k];
        double mean = 0.0;
        Eigen::RowVectorXd gradient = Eigen::RowVectorXd::Zero(design.state.columns());
        for (int i = 0; i < c.size(); ++i) {
          mean += e.value[c.diagonal(i)] / c.size();
          gradient += e.gradient.row(c.diagonal(i)) / c.size();
        }
        (c.top() ? top : bottom) = mean;
        (c.top() ? top_gradient : bottom_gradient) = gradient;
      }
      if (p_->problem.objective.index == Index::speed) add(top, top_gradient, r.level);
      else add(top - bottom, top_gradient - bottom_gradient, r.level);
    }
    for (std::size_t k = 0; k < groups_.size(); ++k) {
      const Coalesced& c = groups_[k];
      const Coalesced::Entries& e = entries[k];
      for (int i = 0; i < c.size(); ++i)
        for (int j = i; j < c.size(); ++j) {
          const int entry = c.diagonal(i) + j - i;
          if (j > i) add(e.value[entry], e.gradient.row(entry), -1);
          else if (i > 0) add(e.value[entry] - e.value[0], e.gradient.row(entry) - e.gradient.row(0), -1);
        }
    }
    return out;
  }

 private:
  struct PoseLevel {
    int pose, level;
  };

  const PreparedProblem* p_;
  std::vector<int> plain_;  ///< indices into PreparedProblem::row_levels, of the other poses
  std::vector<int> margins_;
  std::vector<PoseLevel> pose_levels_;  ///< of poses with singular values held equal
  std::vector<Coalesced> groups_;
};

/// Curvature of the objective in its levels, by differences of its slopes.
Eigen::MatrixXd level_curvature(const PreparedProblem& p, const Eigen::VectorXd& levels) {
  Eigen::MatrixXd out(p.levels, p.levels);
  Eigen::VectorXd slopes, ahead;
  p.objective(levels, &slopes);
  for (Eigen::Index k = 0; k < p.levels; ++k) {
    Eigen::VectorXd near = levels;
    near[k] += difference_step;
    p.objective(near, &ahead);
    out.col(k) = (ahead - slopes) / difference_step;
  }
  return 0.5 * (out + out.transpose());
}

}  // namespace

Eigen::VectorXd polish(const PreparedProblem& p, const Eigen::VectorXd& start, const ActiveSet& active, double gap) {
  const int n = p.coordinates.size();
  Eigen::VectorXd y = start;
  DesignEvaluation design, ahead;
  design.state.length_joint = ahead.state.length_joint = p.pieces(y).front();
  std::vector<bool> held(at_index(n), false);
  for (const int k : active.at_low) {
    held[at_index(k)] = true;
    y[k] = p.coordinates.low()[k];
  }
  for (const int k : active.at_high) {
    held[at_index(k)] = true;
    y[k] = p.coordinates.high()[k];
  }
  const RowSelection rows = selection_of(p, active.row_levels, active.margins);
  evaluate_design(p, y, design, &rows);
  std::vector<Eigen::Index> moving;
  for (int k = 0; k < n; ++k)
    if (!held[at_index(k)]) moving.push_back(k);
  const auto m = static_cast<Eigen::Index>(moving.size());
  const ActiveEquations equations(p, design, active, gap);
  const Eigen::Index levels = p.levels, unknowns = m + levels;
  Eigen::VectorXd t = design.levels;

  for (int step = 0; step < newton_steps && m > 0; ++step) {
    // Unknowns (y, t); equations value = t of their level, or 0.
    const Equations e = equations.at(design);
    const Eigen::Index count = e.value.size();
    const Eigen::MatrixXd g = e.gradient(Eigen::all, moving);
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(count, unknowns);
    jacobian.leftCols(m) = g;
    Eigen::VectorXd miss = e.value;
    for (Eigen::Index k = 0; k < count; ++k) {
      const int level = e.level[at_index(k)];
      if (level < 0) continue;
      jacobian(k, m + level) = -1.0;
      miss[k] -= t[level];
    }
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(unknowns), slopes;
    p.objective(t, &slopes);
    slope.tail(levels) = slopes;
    const Eigen::VectorXd multipliers = least_norm_transposed(jacobian, -slope);

    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(unknowns + count, unknowns + count);
    for (Eigen::Index k = 0; k < m; ++k) {
      Eigen::VectorXd near = y;
      near[moving[at_index(k)]] += difference_step;
      evaluate_design(p, near, ahead, &rows);
      kkt.col(k).head(m) =
          (equations.at(ahead).gradient(Eigen::all, moving) - g).transpose() * multipliers / difference_step;
    }
    kkt.topLeftCorner(m, m) = (0.5 * (kkt.topLeftCorner(m, m) + kkt.topLeftCorner(m, m).transpose())).eval();
    kkt.block(m, m, levels, levels) = level_curvature(p, t);
    kkt.topRightCorner(unknowns, count) = jacobian.transpose();
    kkt.bottomLeftCorner(count, unknowns) = jacobian;
    Eigen::VectorXd right(unknowns + count);
    right << -(slope + jacobian.transpose() * multipliers), -miss;
    if (!kkt.allFinite() || !right.allFinite()) break;
    const Eigen::VectorXd move = least_norm(kkt, right).head(unknowns);
    if (!move.allFinite() || move.head(m).norm() > 0.1) break;  // not near an optimum after all
    for (Eigen::Index k = 0; k < m; ++k) y[moving[at_index(k)]] += move[k];
    y = y.cwiseMax(p.coordinates.low()).cwiseMin(p.coordinates.high());
    t += move.tail(levels);
    evaluate_design(p, y, design, &rows);
    if (move.head(m).norm() < 1e-12) break;
  }
  return y;
}

}  // namespace ninedof
