#include "optimize/polish/active_set.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof {
namespace {

constexpr double tie = 1e-6;            // of objective rows that count as equal
constexpr double near_bound = 1e-7;     // of a coordinate that may be on its way to its bound
constexpr double limit_contact = 1e-6;  // of a margin that counts as zero
constexpr double order_contact = 1e-9;  // of the logarithm of zp / zs; large robots come close to 0

void add_once(std::vector<std::string>& list, const std::string& name) {
  if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
}

}  // namespace

ActiveSet active_set(const Prepared& p, const Look& l, const Eigen::VectorXd& y, Contact contact) {
  const double bound_contact = contact == Contact::exact ? 1e-12 : near_bound;
  const Coordinates& c = p.coordinates;
  ActiveSet a;
  for (std::size_t k = 0; k < p.uses.size(); ++k)
    if (l.levels[p.uses[k].level] - l.f[p.uses[k].row] <= tie) a.uses.push_back(static_cast<int>(k));
  for (Eigen::Index k = 0; k < l.m.size(); ++k)
    if (l.m[k] <= limit_contact) a.margins.push_back(static_cast<int>(k));
  for (int k = 0; k < c.size(); ++k) {
    if (y[k] - c.low()[k] <= bound_contact) a.at_low.push_back(k);
    if (c.high()[k] - y[k] <= bound_contact) a.at_high.push_back(k);
  }
  a.order = c.order_margin(y) <= order_contact;
  return a;
}

std::vector<std::string> names(const Prepared& p, const ActiveSet& a) {
  std::vector<std::string> out;
  // A range of ours is no bound of the study, but the reach of O is worth a word.
  const auto shown = [&](int k, bool ours) {
    if (!ours || p.coordinates.info(k).kind == VariableKind::fraction) add_once(out, p.coordinates.info(k).name);
  };
  for (const int k : a.at_low) shown(k, p.coordinates.capped_low(k));
  for (const int k : a.at_high) shown(k, p.coordinates.capped_high(k));
  for (const int k : a.margins) add_once(out, p.margin_name(k));
  if (a.order) add_once(out, "zp > zs");
  return out;
}

std::vector<std::string> conflict(const Prepared& p, const Look& l, const Eigen::VectorXd& y) {
  const Eigen::Index n = p.coordinates.size();
  const double worst = violation(p, l, y);
  std::vector<Eigen::VectorXd> columns;
  std::vector<std::string> labels;
  for (Eigen::Index k = 0; k < l.m.size(); ++k) {
    if (l.m[k] > -worst + limit_contact) continue;
    columns.emplace_back(l.m_gradient.row(k));
    labels.push_back(p.margin_name(static_cast<int>(k)));
  }
  const double out_of_order = order_violation(p, l, y);
  if (out_of_order > 0.0 && out_of_order >= worst - limit_contact) {
    columns.emplace_back(p.coordinates.order().gradient);
    labels.emplace_back("zp > zs");
  }
  const std::size_t violated = labels.size();
  for (int k = 0; k < n; ++k) {
    const bool low = y[k] - p.coordinates.low()[k] <= 1e-5, high = p.coordinates.high()[k] - y[k] <= 1e-5;
    if (low) columns.emplace_back(Eigen::VectorXd::Unit(n, k));
    if (high) columns.emplace_back(-Eigen::VectorXd::Unit(n, k));
    for (int side = 0; side < low + high; ++side) labels.push_back(p.coordinates.info(k).name);
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

}  // namespace ninedof
