#pragma once
/// Design problems for the tests of the optimizer, and an opinion on its answers that does not come from it: limits by
/// hand from joints and legs, condition numbers by the general path of conditioning.hpp.

#include <algorithm>
#include <array>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/optimize/optimize.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/support.hpp"

namespace studies {

using namespace support;
using ninedof::Candidate;
using ninedof::Limit;
using ninedof::Problem;
using ninedof::Result;
using ninedof::Settings;
using ninedof::Status;

/// Proved to be the least condition number of the paper's study (theory-certificates.md).
constexpr double paper_optimum = 3.762659078596047;

inline const ninedof::DesignFamily& hexagonal() {
  return ninedof::design_family("hexagonal");
}

/// Default bounds, base at most twice the platform.
inline Problem paper_study() {
  Problem p;
  for (const auto& v : hexagonal().variables()) p.variables.push_back({v.low, v.high});
  p.limits = {{.name = "radius_ratio", .high = 2.0}};
  return p;
}

/// No limits; sides up to `sides`, heights up to `heights`, no twist: eqs. (8)-(9).
inline Problem open_study(double sides, double heights) {
  Problem p;
  for (int k = 0; k < 6; ++k) p.variables.push_back({0.0, k < 4 ? sides : heights});
  p.variables.push_back({0.0, 0.0});
  return p;
}

/// Every variable fixed.
inline Problem fixed_study(const std::array<double, 7>& x) {
  Problem p = paper_study();
  for (std::size_t k = 0; k < x.size(); ++k) p.variables[k] = {x[k], x[k]};
  return p;
}

/// Condition number of the robot the variables describe, the characteristic length a number; infinite where they
/// describe none.
inline double condition_number(const Problem& p, const Eigen::VectorXd& x) {
  try {
    const ninedof::DesignFamily& family = ninedof::design_family(p.family);
    return ninedof::condition_number(family.geometry(span(x)), family.configuration(span(x)),
                                     p.characteristic_length.value);
  } catch (const ninedof::InvalidArgument&) {
    return infinity;
  }
}

/// Whether a design keeps its bounds exactly, zs < zp, and every limit to the tolerance in its ratio.
inline bool allowed(const Problem& p, const Eigen::VectorXd& x, double tolerance = 0.0) {
  for (std::size_t k = 0; k < p.variables.size(); ++k) {
    const double value = x[static_cast<Eigen::Index>(k)];
    if (!(value >= p.variables[k].low && value <= p.variables[k].high)) return false;
  }
  if (!(x[5] < x[4]) || !std::isfinite(condition_number(p, x))) return false;
  const ninedof::Geometry g = hexagonal().geometry(span(x));
  const ninedof::Vec9 lengths = ninedof::leg_lengths(g, hexagonal().configuration(span(x)));
  return std::all_of(p.limits.begin(), p.limits.end(), [&](const Limit& limit) {
    double ratio = x[5] / x[4];
    if (limit.name == "radius_ratio") ratio = g.base_external()[0].norm() / g.platform_external()[0].norm();
    if (limit.name == "leg_ratio") ratio = lengths.maxCoeff() / lengths.minCoeff();
    return ratio <= limit.high * (1.0 + tolerance) && ratio >= limit.low * (1.0 - tolerance);
  });
}

/// The best of many allowed designs drawn around `x` (distances from 1e-6 to 0.3 times the size of each variable).
inline double best_nearby(const Problem& p, const Eigen::VectorXd& x, Random& random, int draws = 2000) {
  double best = infinity;
  for (int n = 0; n < draws; ++n) {
    const double reach = random.log_uniform(1e-6, 0.3);
    Eigen::VectorXd y = x;
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      const auto& b = p.variables[static_cast<std::size_t>(k)];
      if (random.uniform(0.0, 1.0) < 0.6)
        y[k] += reach * std::max(p.characteristic_length.value, std::abs(x[k])) * random.normal();
      y[k] = std::clamp(y[k], b.low, b.high);
    }
    // Follow the limit of the paper's study, or hardly any draw is allowed: the platform carries the base's size.
    if (n % 2 == 0 && !p.limits.empty() && p.limits.front().name == "radius_ratio") {
      const double radius = std::hypot(y[0], y[1], std::sqrt(y[0] * y[1])) / p.limits.front().high;
      const double now = std::hypot(y[2], y[3], std::sqrt(y[2] * y[3]));
      for (const Eigen::Index k : {2, 3}) {
        const auto& b = p.variables[static_cast<std::size_t>(k)];
        y[k] = std::clamp(y[k] * (radius / now) * (1.0 + 4.0 * eps), b.low, b.high);
      }
    }
    if (allowed(p, y)) best = std::min(best, condition_number(p, y));
  }
  return best;
}

inline bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

inline bool same_bits(const Candidate& a, const Candidate& b) {
  return a.variables == b.variables && a.objective == b.objective && a.condition_number == b.condition_number &&
         a.conditions == b.conditions && a.prices == b.prices && a.optimality_residual == b.optimality_residual &&
         a.constraint_violation == b.constraint_violation && a.active == b.active && a.reached == b.reached;
}

inline bool same_bits(const Result& a, const Result& b) {
  return a.status == b.status && a.reason == b.reason && a.causes == b.causes && a.evaluations == b.evaluations &&
         a.starts_done == b.starts_done && a.runs_abandoned == b.runs_abandoned &&
         std::equal(a.candidates.begin(), a.candidates.end(), b.candidates.begin(), b.candidates.end(),
                    [](const Candidate& x, const Candidate& y) { return same_bits(x, y); });
}

}  // namespace studies
