#include "optimize/polish/polish.hpp"

#include "math/linear/least_squares.hpp"
#include "optimize/polish/equations.hpp"

namespace ninedof {
namespace {

constexpr int newton_steps = 6;
/// Smoothed singular values that coincide in the limit are within this many smoothings of the extreme one.
constexpr double group_width = 7.0;
constexpr double difference_step = 1e-6;  // of solver coordinates, which are of order one

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

Eigen::VectorXd polish(const PreparedProblem& p, const Eigen::VectorXd& start, double smoothing) {
  const int n = p.coordinates.size();
  Eigen::VectorXd y = start;
  DesignEvaluation design, ahead;
  design.smoothing = smoothing;
  evaluate_design(p, y, design);
  const ActiveSet active = active_set(p, design, y, Contact::near);
  design.smoothing = 0.0;
  std::vector<bool> held(static_cast<std::size_t>(n), false);
  for (const int k : active.at_low) {
    held[static_cast<std::size_t>(k)] = true;
    y[k] = p.coordinates.low()[k];
  }
  for (const int k : active.at_high) {
    held[static_cast<std::size_t>(k)] = true;
    y[k] = p.coordinates.high()[k];
  }
  evaluate_design(p, y, design);
  std::vector<Eigen::Index> moving;
  for (int k = 0; k < n; ++k)
    if (!held[static_cast<std::size_t>(k)]) moving.push_back(k);
  const auto m = static_cast<Eigen::Index>(moving.size());
  const ActiveEquations equations(p, design, active, group_width * smoothing);
  const Eigen::Index levels = p.levels, unknowns = m + levels;
  Eigen::VectorXd t = design.levels;

  for (int step = 0; step < newton_steps && m > 0; ++step) {
    // Unknowns (y, t); equations value = t of their level, or 0.
    const Equations e = equations.at(design);
    const Eigen::Index rows = e.value.size();
    const Eigen::MatrixXd g = e.gradient(Eigen::all, moving);
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows, unknowns);
    jacobian.leftCols(m) = g;
    Eigen::VectorXd miss = e.value;
    for (Eigen::Index k = 0; k < rows; ++k) {
      const int level = e.level[static_cast<std::size_t>(k)];
      if (level < 0) continue;
      jacobian(k, m + level) = -1.0;
      miss[k] -= t[level];
    }
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(unknowns), slopes;
    p.objective(t, &slopes);
    slope.tail(levels) = slopes;
    const Eigen::VectorXd multipliers = least_norm_transposed(jacobian, -slope);

    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(unknowns + rows, unknowns + rows);
    for (Eigen::Index k = 0; k < m; ++k) {
      Eigen::VectorXd near = y;
      near[moving[static_cast<std::size_t>(k)]] += difference_step;
      evaluate_design(p, near, ahead);
      kkt.col(k).head(m) =
          (equations.at(ahead).gradient(Eigen::all, moving) - g).transpose() * multipliers / difference_step;
    }
    kkt.topLeftCorner(m, m) = (0.5 * (kkt.topLeftCorner(m, m) + kkt.topLeftCorner(m, m).transpose())).eval();
    kkt.block(m, m, levels, levels) = level_curvature(p, t);
    kkt.topRightCorner(unknowns, rows) = jacobian.transpose();
    kkt.bottomLeftCorner(rows, unknowns) = jacobian;
    Eigen::VectorXd right(unknowns + rows);
    right << -(slope + jacobian.transpose() * multipliers), -miss;
    if (!kkt.allFinite() || !right.allFinite()) break;
    const Eigen::VectorXd move = least_norm(kkt, right).head(unknowns);
    if (!move.allFinite() || move.head(m).norm() > 0.1) break;  // not near an optimum after all
    for (Eigen::Index k = 0; k < m; ++k) y[moving[static_cast<std::size_t>(k)]] += move[k];
    y = y.cwiseMax(p.coordinates.low()).cwiseMin(p.coordinates.high());
    t += move.tail(levels);
    evaluate_design(p, y, design);
    if (move.head(m).norm() < 1e-12) break;
  }
  return y;
}

}  // namespace ninedof
