#include "workspace/chart.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ninedof/math/rotation.hpp"

namespace ninedof {
namespace {

using std::numbers::pi;
using enum OrientationRegion::Chart;

double sinc(double t) {
  return t > 1e-4 ? std::sin(t) / t : 1.0 - t * t / 6.0;
}

/// d exp(x) = skew(exp_spin(x) dx) exp(x).
Mat3 exp_spin(const Vec3& x) {
  const double t = x.norm(), half = sinc(0.5 * t);
  const double cubic = t > 1e-2 ? (1.0 - sinc(t)) / (t * t) : (1.0 - t * t / 20.0) / 6.0;
  const Mat3 cross = skew(x);
  return Mat3::Identity() + 0.5 * half * half * cross + cubic * cross * cross;
}

}  // namespace

Chart::Chart(const WorkspaceDomain& domain)
    : positional_(domain.archetype != Archetype::orientation),
      region_(domain.region),
      centre_(domain.rotations.front()) {
  if (positional_) {
    low_ = domain.low;
    high_ = domain.high;
  } else if (region_.chart == rotation_vector) {
    high_.setConstant(region_.angle);
    low_ = -high_;
  } else {
    low_ = {-region_.angle, -region_.angle, region_.torsion_low};
    high_ = {region_.angle, region_.angle, region_.torsion_high};
  }
}

double Chart::density(const Vec3& x) const {
  if (positional_) return 1.0;
  if (region_.chart == tilt_torsion) return sinc(std::min(x.head<2>().norm(), pi));
  // 2 (1 - cos t) / t^2 = (sin(t/2) / (t/2))^2 without cancellation.
  const double ratio = sinc(0.5 * std::min(x.norm(), pi));
  return ratio * ratio;
}

double Chart::volume() const {
  if (positional_) return box_volume();
  if (region_.chart == rotation_vector) return 8.0 * pi * (region_.angle - std::sin(region_.angle));
  return 2.0 * pi * (1.0 - std::cos(region_.angle)) * (region_.torsion_high - region_.torsion_low);
}

double Chart::region_margin(const Vec3& x) const {
  return region_.angle - (region_.chart == rotation_vector ? x.norm() : x.head<2>().norm());
}

int Chart::first_wall() const {
  return positional_ ? 0 : region_.chart == tilt_torsion ? 2 : 3;
}

double Chart::turning() const {
  // exp never stretches; tilt and torsion may add up.
  return positional_ ? 0.0 : region_.chart == rotation_vector ? 1.0 : std::numbers::sqrt2;
}

Mat3 Chart::spin(const Vec3& x) const {
  if (region_.chart == rotation_vector) return exp_spin(x);
  const Vec3 y(-x[1], x[0], 0.0);
  const Mat3 tilt = exp_spin(y);
  Mat3 out;
  out << tilt.col(1), -tilt.col(0), exp_rotation(y).col(2);
  return out;
}

double Chart::bending() const {
  // |d2 Q| <= |w|^2 + |dw| with the angular velocity w. exp has |w| <= 1 and |dw| <= 1/2 along a line. Tilt at speed a
  // and torsion at speed b, a^2 + b^2 = 1, have |w| <= a + b and |dw| <= a^2/2 + a b: 1.5 a^2 + 3 a b + b^2 at most.
  return region_.chart == rotation_vector ? 1.5 : 1.25 + std::sqrt(2.3125);
}

Mat3 Chart::rotation(const Vec3& x) const {
  if (region_.chart == rotation_vector) return exp_rotation(x) * centre_;
  return exp_rotation({-x[1], x[0], 0.0}) * rotation_about_z(x[2]) * centre_;
}

Vec3 Chart::coordinates(const Mat3& q) const {
  const Mat3 r = q * centre_.transpose();
  if (region_.chart == rotation_vector) return log_rotation(r);
  const double tilt = std::atan2(std::hypot(r(0, 2), r(1, 2)), r(2, 2)), towards = std::atan2(r(1, 2), r(0, 2));
  const Vec3 tilt_at{tilt * std::cos(towards), tilt * std::sin(towards), 0.0};
  const Mat3 torsion = exp_rotation({-tilt_at[1], tilt_at[0], 0.0}).transpose() * r;
  return tilt_at + Vec3(0.0, 0.0, std::atan2(torsion(1, 0), torsion(0, 0)));
}

}  // namespace ninedof
