#include "ninedof/conditioning/characteristic_length.hpp"

#include <cmath>

#include "math/linear/jacobi_svd.hpp"
#include "math/numbers.hpp"
#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

double platform_radius(const Geometry& g) {
  double radius = 0.0;
  for (const Triple* t : {&g.platform_external(), &g.platform_internal()})
    for (const Vec3& joint : *t) radius = std::max(radius, joint.norm());
  return radius;
}

/// d log kappa / d log(l_c), with the angular columns of `m` divided by exp(log_length). The derivative of log(sigma)
/// is minus the squared norm of the angular half of its right singular vector.
double slope(const Mat6& m, double log_length) {
  Mat6 scaled = m;
  scaled.leftCols<3>() *= std::exp(-log_length);
  const Mat6 v = jacobi_right_svd(scaled).v;
  return v.col(5).head<3>().squaredNorm() - v.col(0).head<3>().squaredNorm();
}

/// The sign change of f between a and b, f(a) <= 0 <= f(b), by the ITP method of Oliveira and Takahashi (ACM Trans.
/// Math. Softw. 47, 2020): as fast as the secant method, and hardly slower than bisection where f jumps.
template <class F>
double sign_change(const F& f, double a, double at_a, double b, double at_b, double width) {
  const double most = std::ceil(std::log2(std::max(1.0, (b - a) / width))) + 1.0, start = b - a;
  for (double left = std::ldexp(0.5 * width, static_cast<int>(most)); b - a > width; left *= 0.5) {
    const double middle = 0.5 * (a + b), secant = (at_b * a - at_a * b) / (at_b - at_a);
    const double away = middle - secant, nudge = 0.2 / start * (b - a) * (b - a), room = left - 0.5 * (b - a);
    double x = nudge <= std::abs(away) ? secant + std::copysign(nudge, away) : middle;
    if (!(std::abs(x - middle) <= room)) x = middle - std::copysign(room, away);
    if (!(x > a && x < b)) x = middle;  // the secant was rounded to an end
    if (!(x > a && x < b)) break;       // a and b are neighbouring doubles
    const double y = f(x);
    if (y == 0.0) return x;
    (y < 0.0 ? a : b) = x;
    (y < 0.0 ? at_a : at_b) = y;
  }
  return 0.5 * (a + b);
}

/// kappa is quasi-convex in the length: kappa <= K holds if and only if M^T M lies between P and K^2 P for some
/// P = diag(x, x, x, y, y, y), a convex set of (x, y). So the sign of the slope brackets the minimum, even at a kink
/// (docs/theory/conditioning.md).
double optimal(const Mat6& m, double natural) {
  const auto at = [&m](double log_length) { return slope(m, log_length); };
  double low = std::log(natural), high = low, at_low = at(low), at_high = at_low;
  for (double step = 1.0; at_low > 0.0 && step < 1e3; step *= 2.0) {
    high = low;
    at_high = at_low;
    low -= step;
    at_low = at(low);
  }
  for (double step = 1.0; at_high < 0.0 && step < 1e3; step *= 2.0) {
    low = high;
    at_low = at_high;
    high += step;
    at_high = at(high);
  }
  return std::exp(sign_change(at, low, at_low, high, at_high, 1e-15 * std::max(1.0, std::abs(low))));
}

}  // namespace

LengthKind length_kind(const std::string& word) {
  if (word == "mean_leg") return LengthKind::mean_leg;
  if (word == "platform_radius") return LengthKind::platform_radius;
  if (word == "natural") return LengthKind::natural;
  if (word == "optimal") return LengthKind::optimal;
  throw InvalidArgument("kind", "\"" + word + "\"", "\"mean_leg\", \"platform_radius\", \"natural\" or \"optimal\"");
}

double characteristic_length(const Geometry& g, const Configuration& c, LengthKind kind) {
  if (kind == LengthKind::mean_leg) return leg_lengths(g, c).mean();
  if (kind == LengthKind::platform_radius) return platform_radius(g);
  const double unit = platform_radius(g);  // keeps M of order one in any length unit
  const double kappa = condition_number(g, c, unit);
  if (!std::isfinite(kappa)) return not_a_number;
  const Mat6 m = conditioning_matrix(g, c, unit);
  const double natural = m.leftCols<3>().norm() / m.rightCols<3>().norm();
  return unit * (kind == LengthKind::natural ? natural : optimal(m, natural));
}

}  // namespace ninedof
