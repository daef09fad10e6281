#include "optimize/minimax/look.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

/// A margin of the limit on the condition number: which singular values it compares, log(limit) less the difference of their
/// logarithms.
struct ConditionPair {
  int top, bottom;
};
ConditionPair condition_pair(const PoseSpectrum& s, int row) {
  const auto count = s.bottoms().size();
  const auto k = static_cast<std::size_t>(row);
  return {s.tops()[k / count], s.bottoms()[k % count]};
}

void look_at_margins(const Prepared& p, const Wanted* wanted, Look& out) {
  const auto count = static_cast<Eigen::Index>(p.margins.size());
  out.m.resize(count);
  out.m_gradient.resize(count, p.coordinates.size());
  const auto spectrum_of = [&](int constraint) -> const PoseSpectrum& {
    return out.spectra[static_cast<std::size_t>(-1 - constraint)];
  };
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto [constraint, row] = p.margins[static_cast<std::size_t>(k)];
    if (constraint < 0) {
      const PoseSpectrum& s = spectrum_of(constraint);
      const auto [top, bottom] = condition_pair(s, row);
      out.m[k] = std::log(p.problem.objective.condition_limit) - (s.log_sigma[top] - s.log_sigma[bottom]);
    } else out.m[k] = p.constraints[static_cast<std::size_t>(constraint)]->margin(out.view, row);
    if (!(out.m[k] > hopeless_margin)) out.m[k] = hopeless_margin;
  }
  const auto differentiate = [&](Eigen::Index k) {
    const auto [constraint, row] = p.margins[static_cast<std::size_t>(k)];
    out.m_gradient.row(k).setZero();
    if (out.m[k] <= hopeless_margin) return;
    if (constraint < 0) {
      const PoseSpectrum& s = spectrum_of(constraint);
      const auto [top, bottom] = condition_pair(s, row);
      out.m_gradient.row(k) = s.gradient.row(bottom) - s.gradient.row(top);
    } else p.constraints[static_cast<std::size_t>(constraint)]->add_gradient(out.view, row, out.m_gradient.row(k));
  };
  if (wanted == nullptr)
    for (Eigen::Index k = 0; k < count; ++k) differentiate(k);
  else
    for (const int k : wanted->margins) differentiate(k);
}

}  // namespace

void look(const Prepared& p, const Eigen::VectorXd& y, Look& out, const Wanted* wanted) {
  out.view.set(*p.family, p.coordinates, p.problem.characteristic_length, p.places, p.looked, y);
  out.view.unit = p.problem.unit();
  const Eigen::Index n = p.coordinates.size();
  const int poses = std::max(p.looked, 1);
  const Machine machine = p.problem.objective.index == Index::six_legged ? Machine::six_legged : Machine::nine_legged;
  out.spectra.resize(static_cast<std::size_t>(poses));
  out.f.resize(p.rows);
  out.f_gradient.resize(p.rows, n);
  for (int k = 0; k < poses; ++k) {
    PoseSpectrum& s = out.spectra[static_cast<std::size_t>(k)];
    const int place = out.view.first_pose + k;
    if (p.closed[static_cast<std::size_t>(k)])
      closed_spectrum(*p.family, out.view, p.places[static_cast<std::size_t>(place)], machine, s);
    else general_spectrum(out.view, place, s, wanted == nullptr || wanted->poses[static_cast<std::size_t>(k)]);
    if (out.smoothing > 0.0 && p.kinked() && !s.closed)
      fill_soft_index(p.problem.objective.index, s, out.smoothing, p.first_row(k), out.f, out.f_gradient);
    else fill_index(p.problem.objective.index, s, p.first_row(k), out.f, out.f_gradient);
  }
  out.levels.setConstant(p.levels, -infinity);
  for (const Use& u : p.uses) out.levels[u.level] = std::max(out.levels[u.level], out.f[u.row]);
  out.log_objective = p.objective(out.levels);

  look_at_margins(p, wanted, out);
}

double order_violation(const Prepared& p, const Look& l, const Eigen::VectorXd& y) {
  // zs < zp is strict: what is beyond it by any rounding is no design, whatever the tolerance for other limits.
  if (p.coordinates.order_margin(y) >= 0.0) return 0.0;
  return std::max(1e-6, std::log(l.view.blueprint.zs / std::max(l.view.blueprint.zp, 1e-300)));
}

double violation(const Prepared& p, const Look& l, const Eigen::VectorXd& y) {
  double worst = order_violation(p, l, y);
  for (Eigen::Index k = 0; k < l.m.size(); ++k)
    worst = std::max(worst, -p.violation_factor(static_cast<int>(k)) * l.m[k]);
  return worst;
}

double neutral_condition(const Prepared& p, const Look& l) {
  PoseSpectrum s;
  if (p.family->symmetric()) closed_spectrum(*p.family, l.view, p.places.front(), Machine::nine_legged, s);
  else general_spectrum(l.view, 0, s);
  return std::exp(s.log_max() - s.log_min());
}

std::vector<double> conditions(const Prepared& p, const Look& l) {
  if (p.problem.objective.index == Index::six_legged) return {neutral_condition(p, l)};
  std::vector<double> out;
  for (const PoseSpectrum& s : l.spectra) out.push_back(std::exp(s.log_max() - s.log_min()));
  return out;
}

}  // namespace ninedof
