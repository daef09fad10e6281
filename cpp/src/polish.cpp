#include "polish.hpp"

#include <Eigen/QR>
#include <cmath>

#include "active_set.hpp"

namespace ninedof {
namespace {

constexpr int newton_steps = 4;
constexpr double difference_step = 1e-6;  // of solver coordinates, which are of order one

/// The active equations as combinations of quantities: ties of maxima with the first of them, of minima, margins = 0.
struct Equations {
  Eigen::MatrixXd coefficients;  // one row an equation
  Eigen::VectorXd constants;
};

Equations equations(const Prepared& p, const Look& l, const ActiveSet& a) {
  const auto count = static_cast<Eigen::Index>(a.maxima.size() - 1 + a.minima.size() - 1 + a.margins.size());
  Equations e{Eigen::MatrixXd::Zero(count, quantity_count), Eigen::VectorXd::Zero(count)};
  Eigen::Index row = 0;
  for (const auto* ties : {&a.maxima, &a.minima})
    for (std::size_t k = 1; k < ties->size(); ++k, ++row) {
      e.coefficients(row, ties->front()) = -1.0;
      e.coefficients(row, (*ties)[k]) = 1.0;
    }
  for (const int k : a.margins) {
    const Margin::Form& f = p.margins[static_cast<std::size_t>(k)].governing(l.point);
    e.coefficients.row(row) = f.coefficients;
    e.constants[row++] = f.constant;
  }
  return e;
}

}  // namespace

Eigen::VectorXd polish(const Prepared& p, const Eigen::VectorXd& start) {
  const int n = p.coordinates.size();
  Eigen::VectorXd y = start;
  Look l, ahead;
  look(p, y, l);
  const ActiveSet active = active_set(p, l, y);
  std::vector<bool> held(static_cast<std::size_t>(n), false);
  for (const int k : active.at_low) {
    held[static_cast<std::size_t>(k)] = true;
    y[k] = p.coordinates.low()[k];
  }
  for (const int k : active.at_high) {
    held[static_cast<std::size_t>(k)] = true;
    y[k] = p.coordinates.high()[k];
  }
  look(p, y, l);
  std::vector<Eigen::Index> moving;
  for (int k = 0; k < n; ++k)
    if (!held[static_cast<std::size_t>(k)]) moving.push_back(k);
  const auto m = static_cast<Eigen::Index>(moving.size());

  for (int step = 0; step < newton_steps && m > 0; ++step) {
    const Equations e = equations(p, l, active);
    const Eigen::Index rows = e.constants.size();
    // Objective: log of the first maximum minus log of the first minimum; the ties carry the others.
    Eigen::RowVectorXd objective = Eigen::RowVectorXd::Zero(quantity_count);
    objective[active.maxima.front()] = 1.0;
    objective[active.minima.front()] = -1.0;
    const Eigen::MatrixXd g = l.gradient(Eigen::all, moving);
    const Eigen::VectorXd slope = (objective * g).transpose();
    const Eigen::MatrixXd jacobian = e.coefficients * g;
    Eigen::VectorXd multipliers(rows);
    if (rows > 0) multipliers = jacobian.transpose().completeOrthogonalDecomposition().solve(-slope);
    const Eigen::RowVectorXd lagrangian = objective + multipliers.transpose() * e.coefficients;

    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(m + rows, m + rows);
    for (Eigen::Index k = 0; k < m; ++k) {
      Eigen::VectorXd near = y;
      near[moving[static_cast<std::size_t>(k)]] += difference_step;
      look(p, near, ahead);
      kkt.col(k).head(m) = (lagrangian * (ahead.gradient(Eigen::all, moving) - g)).transpose() / difference_step;
    }
    kkt.topLeftCorner(m, m) = (0.5 * (kkt.topLeftCorner(m, m) + kkt.topLeftCorner(m, m).transpose())).eval();
    kkt.topRightCorner(m, rows) = jacobian.transpose();
    kkt.bottomLeftCorner(rows, m) = jacobian;
    Eigen::VectorXd right(m + rows);
    right << -(lagrangian * g).transpose(), -(e.coefficients * l.point.value + e.constants);
    const Eigen::VectorXd move = kkt.completeOrthogonalDecomposition().solve(right).head(m);
    if (!move.allFinite() || move.norm() > 0.1) break;  // not near an optimum after all
    for (Eigen::Index k = 0; k < m; ++k) y[moving[static_cast<std::size_t>(k)]] += move[k];
    y = y.cwiseMax(p.coordinates.low()).cwiseMin(p.coordinates.high());
    look(p, y, l);
    if (move.norm() < 1e-12) break;
  }
  return y;
}

}  // namespace ninedof
