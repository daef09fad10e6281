#include "active_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ninedof {
namespace {

constexpr double tie = 1e-6;            // of log singular values that count as equal
constexpr double bound_contact = 1e-7;  // of a coordinate that counts as on its bound
constexpr double limit_contact = 1e-6;  // of a margin that counts as zero
constexpr double order_contact = 1e-9;  // of the logarithm of zp / zs; large robots come close to 0

void add_once(std::vector<std::string>& list, const std::string& name) {
  if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
}

}  // namespace

ActiveSet active_set(const Prepared& p, const Look& l, const Eigen::VectorXd& y) {
  const Coordinates& c = p.coordinates;
  ActiveSet a;
  for (const int row : {log_axial_max, log_transverse_max})
    if (l.log_max() - l.point.value[row] <= tie) a.maxima.push_back(row);
  for (const int row : {log_axial_min, log_transverse_min})
    if (l.point.value[row] - l.log_min() <= tie) a.minima.push_back(row);
  for (std::size_t k = 0; k < p.margins.size(); ++k)
    if (p.margins[k].value(l.point) <= limit_contact) a.margins.push_back(static_cast<int>(k));
  for (int k = 0; k < c.size(); ++k) {
    if (y[k] - c.low()[k] <= bound_contact) a.at_low.push_back(k);
    if (c.high()[k] - y[k] <= bound_contact) a.at_high.push_back(k);
  }
  a.order = c.order_margin(y) <= order_contact;
  return a;
}

std::vector<std::string> names(const Prepared& p, const ActiveSet& a) {
  std::vector<std::string> out;
  const auto variable = [&](int k) {
    return p.family->variables()[static_cast<std::size_t>(p.coordinates.variable(k))].name;
  };
  // A cap of ours is no bound of the study.
  for (const int k : a.at_low)
    if (!p.coordinates.capped_low(k)) add_once(out, variable(k));
  for (const int k : a.at_high)
    if (!p.coordinates.capped_high(k)) add_once(out, variable(k));
  for (const int k : a.margins) add_once(out, p.margins[static_cast<std::size_t>(k)].name);
  if (a.order) add_once(out, "zp > zs");
  return out;
}

std::vector<std::string> conflict(const Prepared& p, const Look& l, const Eigen::VectorXd& y) {
  const Eigen::Index n = p.coordinates.size();
  const double worst = violation(p, l, y);
  std::vector<Eigen::VectorXd> columns;
  std::vector<std::string> labels;
  const auto variable = [&](int k) {
    return p.family->variables()[static_cast<std::size_t>(p.coordinates.variable(k))].name;
  };
  for (const Margin& m : p.margins) {
    if (m.value(l.point) > -worst + limit_contact) continue;
    columns.emplace_back(l.gradient.transpose() * m.governing(l.point).coefficients);
    labels.push_back(m.name);
  }
  // As `violation` measures it.
  const bool out_of_order = p.coordinates.order_margin(y) < 0.0;
  if (out_of_order && std::max(1e-6, l.point.value[log_zs] - l.point.value[log_zp]) >= worst - limit_contact) {
    columns.emplace_back(p.coordinates.order().gradient);
    labels.emplace_back("zp > zs");
  }
  const std::size_t violated = labels.size();
  for (int k = 0; k < n; ++k) {
    const bool low = y[k] - p.coordinates.low()[k] <= 1e-5, high = p.coordinates.high()[k] - y[k] <= 1e-5;
    if (low) columns.emplace_back(Eigen::VectorXd::Unit(n, k));
    if (high) columns.emplace_back(-Eigen::VectorXd::Unit(n, k));
    for (int side = 0; side < low + high; ++side) labels.push_back(variable(k));
  }
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) system.col(static_cast<Eigen::Index>(k)).head(n) = columns[k];
  system.row(n).head(static_cast<Eigen::Index>(violated)).setOnes();
  const Eigen::VectorXd weights = nonnegative_least_squares(system, Eigen::VectorXd::Unit(n + 1, n));
  std::vector<std::string> out;
  for (std::size_t k = 0; k < labels.size(); ++k)
    if (weights[static_cast<Eigen::Index>(k)] > 1e-4) add_once(out, labels[k]);
  return out;
}

Stationarity stationarity(const Prepared& p, const Look& l, const ActiveSet& a) {
  const Eigen::Index n = p.coordinates.size();
  if (n == 0) return {};
  if (!l.point.value.allFinite() || !l.gradient.allFinite()) return {std::numeric_limits<double>::infinity(), {}};
  std::vector<Eigen::VectorXd> list;
  for (const int row : a.maxima) list.emplace_back(l.gradient.row(row));
  for (const int row : a.minima) list.emplace_back(-l.gradient.row(row));
  for (const int k : a.margins)
    list.emplace_back(-l.gradient.transpose() * p.margins[static_cast<std::size_t>(k)].governing(l.point).coefficients);
  for (const int k : a.at_low) list.emplace_back(-Eigen::VectorXd::Unit(n, k));
  for (const int k : a.at_high) list.emplace_back(Eigen::VectorXd::Unit(n, k));
  if (a.order) list.emplace_back(-p.coordinates.order().gradient);
  Eigen::MatrixXd gradients(n, static_cast<Eigen::Index>(list.size()));
  for (std::size_t k = 0; k < list.size(); ++k) gradients.col(static_cast<Eigen::Index>(k)) = list[k];

  // The two sums as rows of the least-squares problem, weighted like the largest gradient; the weights are then normalised
  // to meet them exactly. Where the residual vanishes they do so anyway.
  const auto n1 = static_cast<Eigen::Index>(a.maxima.size()), n2 = static_cast<Eigen::Index>(a.minima.size());
  const double heavy = std::max(1.0, gradients.cwiseAbs().maxCoeff());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 2, gradients.cols());
  system.topRows(n) = gradients;
  system.row(n).head(n1).setConstant(heavy);
  system.row(n + 1).segment(n1, n2).setConstant(heavy);
  Eigen::VectorXd target = Eigen::VectorXd::Zero(n + 2);
  target.tail(2).setConstant(heavy);
  Eigen::VectorXd w = nonnegative_least_squares(system, target);
  w.head(n1) /= w.head(n1).sum();
  w.segment(n1, n2) /= w.segment(n1, n2).sum();
  return {(gradients * w).norm(), w};
}

}  // namespace ninedof
