#include "ninedof/characteristic_length.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "ninedof/conditioning.hpp"
#include "ninedof/error.hpp"
#include "ninedof/legs.hpp"

namespace ninedof {
namespace {

double platform_radius(const Geometry& g) {
  double radius = 0.0;
  for (const Triple* t : {&g.platform_external(), &g.platform_internal()})
    for (const Vec3& joint : *t) radius = std::max(radius, joint.norm());
  return radius;
}

/// d log kappa / d log(l_c) with the angular columns of `m` divided by exp(log_length): each singular value moves by
/// minus the angular share of its right vector.
double slope(const Mat6& m, double log_length) {
  Mat6 scaled = m;
  scaled.leftCols<3>() *= std::exp(-log_length);
  const Eigen::JacobiSVD<Mat6> svd(scaled, Eigen::ComputeFullV);
  return svd.matrixV().col(5).head<3>().squaredNorm() - svd.matrixV().col(0).head<3>().squaredNorm();
}

/// kappa is quasi-convex in the length: kappa <= K says M^T M lies between P and K^2 P for some P = diag(x, x, x, y, y, y),
/// a convex set of (x, y). So the sign of the slope brackets the minimum, and bisection finds it even at a kink.
double optimal(const Mat6& m, double natural) {
  double low = std::log(natural), high = low;
  for (double step = 1.0; slope(m, low) > 0.0 && step < 1e3; step *= 2.0) low -= step;
  for (double step = 1.0; slope(m, high) < 0.0 && step < 1e3; step *= 2.0) high += step;
  for (int k = 0; k < 200 && high - low > 1e-15 * std::max(1.0, std::abs(low)); ++k) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (slope(m, middle) < 0.0 ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
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
  const double unit = platform_radius(g);  // keeps M of order one whatever the length unit
  const double kappa = condition_number(g, c, unit);
  if (!std::isfinite(kappa)) return std::numeric_limits<double>::quiet_NaN();
  const Mat6 m = conditioning_matrix(g, c, unit);
  const double natural = m.leftCols<3>().norm() / m.rightCols<3>().norm();
  return unit * (kind == LengthKind::natural ? natural : optimal(m, natural));
}

}  // namespace ninedof
