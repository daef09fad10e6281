#include "optimize/minimax/relaxation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

namespace ninedof {
namespace {

/// Variables without their bounds may be so many times as large as any bound of the study.
constexpr double relaxed_range = 1000.0;

/// All rows are given to SLSQP where there are no more; otherwise those this near at first, those nearer than the
/// second once one that was left out is violated, so many times at most.
constexpr std::size_t rows_at_once = 150;
constexpr double near_at_first = 0.2, near_later = 0.05, counts_as_violated = 1e-9;
constexpr int most_selections = 8;

constexpr double degree = std::numbers::pi / 180.0;

std::string digits(double value, int count) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", count, value);
  return text.data();
}

/// `value` with four digits, moved up or down to the next such number.
std::string rounded(double value, bool up) {
  if (!std::isfinite(value) || value == 0.0) return digits(value, 4);
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3.0);
  return digits((up ? std::ceil(value / step - 1e-6) : std::floor(value / step + 1e-6)) * step, 4);
}

const char* suffix(const Limit& limit, bool angle) {
  if (angle) return " deg";
  return limit.of == Unit::zp ? " zp" : limit.of == Unit::radius ? " of the radius" : "";
}

bool is_angle(const Limit& limit) {
  return std::ranges::any_of(limit_rows(), [&](const LimitRow& row) {
    return row.info.kind == LimitKind::angle && limit.name == row.info.name;
  });
}

double largest_bound(const Problem& study) {
  double size = study.unit();
  const auto& info = design_family(study.family).variables();
  for (std::size_t k = 0; k < info.size(); ++k)
    for (const double bound : {study.variables[k].low, study.variables[k].high})
      if (info[k].kind != VariableKind::angle && is_effective_bound(study, bound))
        size = std::max(size, std::abs(bound));
  return size;
}

/// The study with free variables without bounds, but for lengths that are not negative.
Problem without_bounds(Problem study) {
  const auto& info = design_family(study.family).variables();
  for (std::size_t k = 0; k < info.size(); ++k) {
    Bounds& b = study.variables[k];
    if (b.low < b.high) b = {info[k].kind == VariableKind::length ? 0.0 : -infinity, infinity};
  }
  return study;
}

}  // namespace

Relaxation::Relaxation(const Problem& study)
    : p_(without_bounds(study), relaxed_range * largest_bound(study)),
      own_(study, relaxed_range * largest_bound(study)) {
  add_limits();
  add_bounds(study);
}

void Relaxation::add_limits() {
  struct Key {
    int constraint;
    Side side;
    bool operator==(const Key&) const = default;
  };
  std::vector<Key> keys;
  for (std::size_t k = 0; k < p_.margins.size(); ++k) {
    const auto [constraint, row] = p_.margins[k];
    if (constraint >= static_cast<int>(p_.problem.limits.size())) {
      rules_.push_back(static_cast<int>(k));
      continue;
    }
    // A limit on the condition number at the poses is one, whatever the pose.
    const Key key = constraint < 0 ? Key{-1 - constraint < p_.evaluated_poses() ? -1 : -2, Side::high}
                                   : Key{constraint, p_.constraints[at_index(constraint)]->side_of(row)};
    const auto known = std::ranges::find(keys, key);
    const auto at = static_cast<std::size_t>(known - keys.begin());
    if (known == keys.end()) {
      keys.push_back(key);
      StudyDemand demand{.name = p_.margin_name(static_cast<int>(k)), .words = "", .margins = {}};
      const bool high = key.side == Side::high;
      double bound = p_.condition_limit(std::max(0, -1 - constraint));
      const char* unit = "";
      if (constraint >= 0) {
        const Limit& limit = p_.problem.limits[at_index(constraint)];
        bound = (high ? limit.high : limit.low) / (is_angle(limit) ? degree : 1.0);
        unit = suffix(limit, is_angle(limit));
      }
      demand.words = demand.name + (high ? " <= " : " >= ") + digits(bound, 6) + unit;
      demands_.push_back(std::move(demand));
    }
    demands_[at].margins.push_back(static_cast<int>(k));
  }
}

void Relaxation::add_bounds(const Problem& study) {
  const auto& info = design_family(study.family).variables();
  for (std::size_t v = 0; v < info.size(); ++v) {
    const Bounds& b = study.variables[v];
    const int k = p_.coordinates.coordinate(static_cast<int>(v));
    if (k < 0) continue;
    const std::string& name = info[v].name;
    if (info[v].kind == VariableKind::angle) {
      if (!(b.high - b.low < 2.0 * std::numbers::pi - 1e-9)) continue;
      const auto text = [](double angle) { return digits(angle / degree, 6); };
      demands_.push_back({name, name + " in [" + text(b.low) + ", " + text(b.high) + "] deg", {}, k, b.low, b.high});
      continue;
    }
    Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(full_variables(p_.problem).size()));
    const auto in_coordinates = [&](double bound) {
      x[static_cast<Eigen::Index>(v)] = bound;
      return p_.coordinates.coordinates(x)[k];
    };
    const bool low = info[v].kind == VariableKind::length ? b.low > 0.0 : is_effective_bound(study, b.low);
    if (low) demands_.push_back({name, name + " >= " + digits(b.low, 6), {}, k, in_coordinates(b.low), infinity});
    if (is_effective_bound(study, b.high))
      demands_.push_back({name, name + " <= " + digits(b.high, 6), {}, k, -infinity, in_coordinates(b.high)});
  }
}

Eigen::VectorXd Relaxation::start(int index, std::uint64_t seed) const {
  return coordinates(own_.without_auxiliary(own_.coordinates.variables(own_.coordinates.start(index, seed))));
}

Eigen::VectorXd Relaxation::coordinates(const Eigen::VectorXd& variables) const {
  return p_.with_auxiliary(p_.coordinates.coordinates(variables));
}

DesignEvaluation Relaxation::evaluated(const Eigen::VectorXd& y) const {
  DesignEvaluation design;
  const RowSelection none = selection_of(p_);
  evaluate_design(p_, y, design, &none);
  return design;
}

double Relaxation::violation(const StudyDemand& d, const DesignEvaluation& design, const Eigen::VectorXd& y) const {
  double worst = 0.0;
  for (const int k : d.margins) worst = std::max(worst, -p_.violation_factor(k) * design.margins[k]);
  return d.is_bound() ? std::max({worst, d.low - y[d.coordinate], y[d.coordinate] - d.high}) : worst;
}

std::vector<double> Relaxation::violations(const Eigen::VectorXd& y) const {
  const DesignEvaluation design = evaluated(y);
  std::vector<double> out;
  for (const StudyDemand& d : demands_) out.push_back(violation(d, design, y));
  return out;
}

double Relaxation::violation(const Eigen::VectorXd& y, const Demands& counted) const {
  const DesignEvaluation design = evaluated(y);
  double worst = order_violation(p_, design, y);
  for (const int k : rules_) worst = std::max(worst, -design.margins[k]);
  for (std::size_t d = 0; d < demands_.size(); ++d)
    if (counted[d]) worst = std::max(worst, violation(demands_[d], design, y));
  return worst;
}

std::vector<int> Relaxation::poses(const Eigen::VectorXd& y, const Demands& counted) const {
  const DesignEvaluation design = evaluated(y);
  const DesignState& state = design.state;
  if (p_.problem.objective.poses.empty()) return {};
  const double nearly_worst = violation(y, counted) - same_violation;
  std::set<int> out;
  for (std::size_t d = 0; d < demands_.size(); ++d) {
    if (!counted[d] || violation(demands_[d], design, y) < nearly_worst) continue;
    for (const int k : demands_[d].margins) {
      if (-p_.violation_factor(k) * design.margins[k] < nearly_worst) continue;
      for (const int pose : poses_of_margin(p_, state, k)) out.insert(p_.objective_pose(pose));
    }
  }
  out.erase(-1);  // home
  return {out.begin(), out.end()};
}

Eigen::VectorXd Relaxation::least(const Eigen::VectorXd& start, const Demands& counted, const Demands& give,
                                  int max_evaluations, const std::stop_token& stop, long& evaluations) const {
  const int n = p_.coordinates.size();
  if (n == 0) return start;
  // Rows of margins with the share of t that they are given, and the box of the coordinates.
  std::vector<double> share(p_.margins.size(), -1.0);  // -1: does not count
  Eigen::VectorXd low = p_.coordinates.low(), high = p_.coordinates.high();
  std::vector<const StudyDemand*> moved;  // bounds that give
  for (std::size_t d = 0; d < demands_.size(); ++d) {
    if (!counted[d]) continue;
    const StudyDemand& demand = demands_[d];
    for (const int k : demand.margins) share[at_index(k)] = give[d] ? 1.0 / p_.violation_factor(k) : 0.0;
    if (!demand.is_bound()) continue;
    if (give[d]) {
      moved.push_back(&demand);
      continue;
    }
    low[demand.coordinate] = std::max(low[demand.coordinate], demand.low);
    high[demand.coordinate] = std::min(high[demand.coordinate], demand.high);
  }
  for (const int k : rules_) share[at_index(k)] = moved.empty() ? 1.0 : 0.0;

  DesignEvaluation design;
  Eigen::VectorXd y = p_.with_auxiliary(start.cwiseMax(low).cwiseMin(high));
  RowSelection selection;
  selection.alone = true;
  const auto select = [&](const Eigen::VectorXd& at, double t, double near) {
    const DesignEvaluation here = evaluated(at);
    bool violated = false;
    for (std::size_t k = 0; k < share.size(); ++k) {
      const double slack = here.margins[static_cast<Eigen::Index>(k)] + share[k] * t;
      if (share[k] < 0.0 || slack > near || std::ranges::binary_search(selection.margins, static_cast<int>(k)))
        continue;
      violated |= slack < -counts_as_violated;
      selection.margins.insert(std::ranges::upper_bound(selection.margins, static_cast<int>(k)), static_cast<int>(k));
    }
    selection.spectra.assign(at_index(p_.evaluated_spectra()), false);
    for (const int k : selection.margins)
      if (const int c = p_.margins[at_index(k)].constraint; c < 0) selection.spectra[at_index(-1 - c)] = true;
    return violated;
  };

  Demands giving = counted;
  for (std::size_t d = 0; d < giving.size(); ++d) giving[d] = counted[d] && give[d];
  double t = violation(y, giving);
  select(y, t, share.size() <= rows_at_once ? infinity : near_at_first);
  for (int k = 0; k < most_selections && !stop.stop_requested(); ++k) {
    Nlp nlp;
    nlp.variables = n + 1;
    nlp.constraints = static_cast<Eigen::Index>(selection.margins.size() + 2 * moved.size() + 1);
    nlp.low.resize(n + 1);
    nlp.high.resize(n + 1);
    nlp.low << low, 0.0;
    nlp.high << high, infinity;
    nlp.evaluate = [&](const Eigen::VectorXd& at, Nlp::Values& out) {
      evaluate_design(p_, at.head(n), design, &selection);
      ++evaluations;
      out.f = at[n];
      out.f_gradient.setZero();
      out.f_gradient[n] = 1.0;
      out.c_gradient.setZero();
      Eigen::Index row = 0;
      for (const int m : selection.margins) {
        out.c[row] = -design.margins[m] - share[at_index(m)] * at[n];
        out.c_gradient.row(row).head(n) = -design.margin_gradient.row(m);
        out.c_gradient(row++, n) = -share[at_index(m)];
      }
      for (const StudyDemand* bound : moved)
        for (const double side : {-1.0, 1.0}) {
          const double end = side < 0.0 ? bound->low : bound->high;
          const bool finite = std::isfinite(end);
          out.c[row] = finite ? side * (at[bound->coordinate] - end) - at[n] : -1.0;
          if (finite) {
            out.c_gradient(row, bound->coordinate) = side;
            out.c_gradient(row, n) = -1.0;
          }
          ++row;
        }
      out.c[row] = -p_.coordinates.order_margin(at.head(n));
      out.c_gradient.row(row).head(n) = -p_.coordinates.order().gradient.transpose();
      return !stop.stop_requested();
    };
    Eigen::VectorXd full(n + 1);
    full << y, t;
    const Eigen::VectorXd end = slsqp(nlp, full, {.max_evaluations = max_evaluations});
    y = end.head(n);
    t = end[n];
    if (!select(y, t, near_later)) break;
  }
  return p_.with_auxiliary(y);
}

std::string Relaxation::enough(const StudyDemand& demand, const Eigen::VectorXd& y) const {
  if (demand.is_bound()) {
    const double value = p_.coordinates.variables(y)[p_.coordinates.variable(demand.coordinate)];
    if (p_.coordinates.info(demand.coordinate).kind == VariableKind::angle)
      return demand.name + " = " + digits(value / degree, 4) + " deg";
    const bool high = std::isfinite(demand.high);
    return demand.name + (high ? " <= " : " >= ") + rounded(value, high);
  }
  const DesignEvaluation design = evaluated(y);
  double margin = infinity;
  for (const int k : demand.margins) margin = std::min(margin, p_.violation_factor(k) * design.margins[k]);
  const auto [constraint, row] = p_.margins[at_index(demand.margins.front())];
  if (constraint < 0)
    return demand.name + " <= " + rounded(p_.condition_limit(-1 - constraint) * std::exp(-margin), true);
  const SolverRows& c = *p_.constraints[at_index(constraint)];
  const Side side = c.side_of(row);
  const bool angle = is_angle(c.limit()), high = side == Side::high;
  const double value = c.value_at(side, margin) / (angle ? degree : 1.0);
  return demand.name + (high ? " <= " : " >= ") + rounded(value, high) + suffix(c.limit(), angle);
}

}  // namespace ninedof
