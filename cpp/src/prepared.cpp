#include "prepared.hpp"

#include <algorithm>

namespace ninedof {

Prepared::Prepared(const Problem& given, double cap)
    : problem(given),
      family(&design_family(given.family)),
      margins(ninedof::margins(given.limits)),
      coordinates(given, cap) {}

void look(const Prepared& p, const Eigen::VectorXd& y, Look& out) {
  out.x = p.coordinates.variables(y);
  p.family->evaluate({out.x.data(), static_cast<std::size_t>(out.x.size())}, p.problem.characteristic_length,
                     out.point);
  const Eigen::VectorXd slopes = p.coordinates.slopes(out.x);
  out.gradient.resize(quantity_count, p.coordinates.size());
  for (int k = 0; k < p.coordinates.size(); ++k)
    out.gradient.col(k) = slopes[k] * out.point.gradient.col(p.coordinates.variable(k));
}

double violation(const Prepared& p, const Look& l, const Eigen::VectorXd& y) {
  // zs < zp is strict: what is beyond it by any rounding is no design, whatever the tolerance for other limits.
  const double order = p.coordinates.order_margin(y);
  double worst = order < 0.0 ? std::max(1e-6, l.point.value[log_zs] - l.point.value[log_zp]) : 0.0;
  for (const Margin& m : p.margins) worst = std::max(worst, -m.value(l.point));
  return worst;
}

}  // namespace ninedof
