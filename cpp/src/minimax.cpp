#include "minimax.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "slsqp.hpp"
#include "stationarity.hpp"

namespace ninedof {
namespace {

constexpr std::array<int, 2> maxima{log_axial_max, log_transverse_max};
constexpr std::array<int, 2> minima{log_axial_min, log_transverse_min};
constexpr double tie = 1e-6;            // of log singular values that count as equal
constexpr double bound_contact = 1e-7;  // of a coordinate that counts as on its bound
constexpr double limit_contact = 1e-6;  // of a margin that counts as zero

std::span<const double> span_of(const Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

/// A design at solver coordinates y, gradients taken to the free coordinates.
struct Look {
  DesignPoint point;
  Eigen::VectorXd x;
  Eigen::Matrix<double, quantity_count, Eigen::Dynamic> gradient;
};

void look(const Prepared& p, const Eigen::VectorXd& y, Look& out) {
  out.x = p.coordinates.variables(y);
  p.family->evaluate(span_of(out.x), p.problem.characteristic_length, out.point);
  const Eigen::VectorXd slopes = p.coordinates.slopes(out.x);
  out.gradient.resize(quantity_count, p.coordinates.size());
  for (int k = 0; k < p.coordinates.size(); ++k)
    out.gradient.col(k) = slopes[k] * out.point.gradient.col(p.coordinates.variable(k));
}

double order_margin(const Coordinates& c, const Eigen::VectorXd& y) {
  return c.order().gradient.dot(y) + c.order().constant;
}

double violation(const Prepared& p, const DesignPoint& point, const Eigen::VectorXd& y) {
  double worst = std::max(0.0, -order_margin(p.coordinates, y));
  for (const Margin& m : p.margins) worst = std::max(worst, -m.value(point));
  return worst;
}

void add(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

Eigen::MatrixXd columns(const std::vector<Eigen::VectorXd>& list, Eigen::Index rows) {
  Eigen::MatrixXd out(rows, static_cast<Eigen::Index>(list.size()));
  for (std::size_t k = 0; k < list.size(); ++k) out.col(static_cast<Eigen::Index>(k)) = list[k];
  return out;
}

/// Gradients of those of `rows` within `tie` of the extreme one.
Eigen::MatrixXd tied(const Look& l, const std::array<int, 2>& rows, double extreme) {
  std::vector<Eigen::VectorXd> list;
  for (const int row : rows)
    if (std::abs(l.point.value[row] - extreme) <= tie) list.emplace_back(l.gradient.row(row));
  return columns(list, l.gradient.cols());
}

/// Writes the design's own constraints as c <= 0 from row `row` on; returns the row after.
Eigen::Index write_constraints(const Prepared& p, const Look& l, const Eigen::VectorXd& y, Eigen::Index row, Nlp::Values& out) {
  const int n = p.coordinates.size();
  for (const Margin& m : p.margins) {
    const Margin::Form& f = m.governing(l.point);
    out.c[row] = -(f.constant + f.coefficients.dot(l.point.value));
    out.c_gradient.row(row).head(n) = -(f.coefficients.transpose() * l.gradient);
    ++row;
  }
  out.c[row] = -order_margin(p.coordinates, y.head(n));
  out.c_gradient.row(row).head(n) = -p.coordinates.order().gradient.transpose();
  return row + 1;
}

Eigen::Index constraint_count(const Prepared& p) {
  return static_cast<Eigen::Index>(p.margins.size()) + 1;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// An Nlp over the free coordinates and `extra` unbounded ones.
Nlp blank(const Prepared& p, int extra, Eigen::Index constraints) {
  Nlp nlp;
  const int n = p.coordinates.size();
  nlp.variables = n + extra;
  nlp.constraints = constraints;
  nlp.low.setConstant(n + extra, -infinity);
  nlp.high.setConstant(n + extra, infinity);
  nlp.low.head(n) = p.coordinates.low();
  nlp.high.head(n) = p.coordinates.high();
  return nlp;
}

/// Objective alpha - beta over (y, alpha, beta); rows: maxima <= alpha, minima >= beta.
void fill_minimax(const Prepared& p, const Look& l, const Eigen::VectorXd& y, Nlp::Values& out) {
  const int n = p.coordinates.size();
  out.f = y[n] - y[n + 1];
  out.f_gradient.setZero();
  out.f_gradient[n] = 1.0;
  out.f_gradient[n + 1] = -1.0;
  Eigen::Index row = 0;
  for (const int k : maxima) {
    out.c[row] = l.point.value[k] - y[n];
    out.c_gradient.row(row).head(n) = l.gradient.row(k);
    out.c_gradient(row++, n) = -1.0;
  }
  for (const int k : minima) {
    out.c[row] = y[n + 1] - l.point.value[k];
    out.c_gradient.row(row).head(n) = -l.gradient.row(k);
    out.c_gradient(row++, n + 1) = 1.0;
  }
  write_constraints(p, l, y, row, out);
}

void fill_plain(const Prepared& p, const Look& l, const Eigen::VectorXd& y, Nlp::Values& out) {
  out.f = l.point.log_condition_number();
  const Eigen::VectorXd full = l.point.log_condition_number_gradient();
  const Eigen::VectorXd slopes = p.coordinates.slopes(l.x);
  for (int k = 0; k < p.coordinates.size(); ++k) out.f_gradient[k] = slopes[k] * full[p.coordinates.variable(k)];
  write_constraints(p, l, y, 0, out);
}

}  // namespace

Prepared::Prepared(const Problem& given, double cap)
    : problem(given),
      family(&design_family(given.family)),
      margins(ninedof::margins(given.limits)),
      coordinates(given, cap) {}

Candidate judge(const Prepared& p, const Eigen::VectorXd& x) {
  const Coordinates& c = p.coordinates;
  const Eigen::VectorXd y = c.coordinates(x);
  Look l;
  look(p, y, l);
  Candidate out;
  out.variables = l.x;
  out.condition_number = std::exp(l.point.log_condition_number());
  out.constraint_violation = violation(p, l.point, y);

  std::vector<Eigen::VectorXd> inward;
  for (int k = 0; k < c.size(); ++k) {
    const bool at_low = y[k] - c.low()[k] <= bound_contact, at_high = c.high()[k] - y[k] <= bound_contact;
    if (at_low) inward.emplace_back(Eigen::VectorXd::Unit(c.size(), k));
    if (at_high) inward.emplace_back(-Eigen::VectorXd::Unit(c.size(), k));
    if (at_low || at_high) add(out.active, p.family->variables()[static_cast<std::size_t>(c.variable(k))].name);
  }
  for (const Margin& m : p.margins) {
    const Margin::Form& f = m.governing(l.point);
    if (f.constant + f.coefficients.dot(l.point.value) > limit_contact) continue;
    inward.emplace_back(l.gradient.transpose() * f.coefficients);
    add(out.active, m.name);
  }
  if (order_margin(c, y) <= limit_contact) {
    inward.emplace_back(c.order().gradient);
    add(out.active, "zp > zs");
  }
  const double top = std::max(l.point.value[log_axial_max], l.point.value[log_transverse_max]);
  const double bottom = std::min(l.point.value[log_axial_min], l.point.value[log_transverse_min]);
  out.optimality_residual =
      c.size() == 0 ? 0.0 : stationarity_residual({tied(l, maxima, top), tied(l, minima, bottom), columns(inward, c.size())});
  return out;
}

namespace {

/// Whether `next` is the better point to stand on: allowed before not allowed, then the lower condition number, then, of two
/// equal ones, the more nearly stationary.
bool improves(const Candidate& next, const Candidate& now) {
  if (next.feasible() != now.feasible()) return next.feasible();
  if (!next.feasible()) return next.constraint_violation < now.constraint_violation;
  if (std::abs(next.condition_number - now.condition_number) > 1e-10 * now.condition_number)
    return next.condition_number < now.condition_number;
  return next.optimality_residual < now.optimality_residual;
}

}  // namespace

Run minimise(const Prepared& p, const Eigen::VectorXd& start, Formulation formulation, int max_evaluations,
             const std::stop_token& stop, const std::function<void(const DesignPoint&, double)>& observer) {
  const bool minimax = formulation == Formulation::minimax;
  const int n = p.coordinates.size();
  Run run;
  Eigen::VectorXd y = p.coordinates.coordinates(start);
  run.end = judge(p, p.coordinates.variables(y));
  if (n == 0) return run;

  Look l;
  Nlp nlp = blank(p, minimax ? 2 : 0, (minimax ? 4 : 0) + constraint_count(p));
  nlp.evaluate = [&](const Eigen::VectorXd& at, Nlp::Values& out) {
    look(p, at.head(n), l);
    ++run.evaluations;
    minimax ? fill_minimax(p, l, at, out) : fill_plain(p, l, at, out);
    if (observer) observer(l.point, violation(p, l.point, at.head(n)));
    return !stop.stop_requested();
  };

  constexpr int restarts = 3;
  for (int attempt = 0; attempt <= restarts && !stop.stop_requested(); ++attempt) {
    Eigen::VectorXd full(nlp.variables);
    full.head(n) = y;
    if (minimax) {
      look(p, y, l);
      full[n] = std::max(l.point.value[log_axial_max], l.point.value[log_transverse_max]);
      full[n + 1] = std::min(l.point.value[log_axial_min], l.point.value[log_transverse_min]);
    }
    full = slsqp(nlp, full, {.max_evaluations = max_evaluations});
    const Candidate next = judge(p, p.coordinates.variables(full.head(n)));
    const bool better = improves(next, run.end);
    if (better) {
      run.end = next;
      y = full.head(n);
    }
    if (!better || !minimax || (run.end.feasible() && run.end.stationary())) break;
  }
  return run;
}

Run least_violation(const Prepared& p, const Eigen::VectorXd& start, int max_evaluations, const std::stop_token& stop) {
  const int n = p.coordinates.size();
  Run run;
  Eigen::VectorXd full(n + 1);
  full.head(n) = p.coordinates.coordinates(start);
  Look l;
  look(p, full.head(n), l);
  full[n] = violation(p, l.point, full.head(n));
  Nlp nlp = blank(p, 1, constraint_count(p));
  nlp.low[n] = 0.0;
  nlp.evaluate = [&](const Eigen::VectorXd& at, Nlp::Values& out) {
    look(p, at.head(n), l);
    ++run.evaluations;
    out.f = at[n];
    out.f_gradient.setZero();
    out.f_gradient[n] = 1.0;
    write_constraints(p, l, at, 0, out);
    out.c.array() -= at[n];
    out.c_gradient.col(n).setConstant(-1.0);
    return !stop.stop_requested();
  };
  if (n > 0) full = slsqp(nlp, full, {.max_evaluations = max_evaluations});
  run.end = judge(p, p.coordinates.variables(full.head(n)));
  return run;
}

}  // namespace ninedof
