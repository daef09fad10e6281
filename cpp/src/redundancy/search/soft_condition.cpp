/// Declared in redundancy/search/pose_objective.hpp.
///
/// The Hessian is exact: second derivatives of M^T M, first derivatives between every two singular vectors, divided
/// differences for singular values that nearly coincide.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "redundancy/search/pose_objective.hpp"

namespace ninedof {
namespace {

constexpr double weightless = 1e-17;  // smaller terms are below the rounding of the sum

/// One internal leg, its rate and the velocity across it for each of six singular vectors, over the singular value.
struct Leg {
  Vec3 direction;
  double length;
  Vec6 rate;
  Mat36 across;
};

std::array<Leg, 6> internal_legs(const Points& at, const NineLegs& legs, const Spectrum& s) {
  const Mat36 omega = s.twist.topRows<3>() / s.characteristic_length;
  std::array<Leg, 6> out;
  for (int k = 3; k < 9; ++k) {
    const auto place = at_index(k);
    Leg& leg = out[place - 3];
    leg.direction = legs.direction[place];
    leg.length = legs.length[k];
    for (int a = 0; a < 6; ++a) {
      Vec3 velocity = s.sdot.col(a);
      if (k < 6) {
        const Vec3 lever = at[at_index(leg_ends(k).from)] - at[point_p];
        velocity -= s.twist.col(a).tail<3>() + omega.col(a).cross(lever);
      }
      leg.rate[a] = s.rates(k, a) / s.sigma[a];
      leg.across.col(a) = (velocity - s.rates(k, a) * leg.direction) / s.sigma[a];
    }
  }
  return out;
}

/// d(v_a^T M^T M v_b) / (sigma_a sigma_b), both vectors fixed.
Vec3 mixed_slope(const std::array<Leg, 6>& legs, int a, int b) {
  Vec3 out = Vec3::Zero();
  for (const Leg& leg : legs) out += (leg.rate[a] * leg.across.col(b) + leg.rate[b] * leg.across.col(a)) / leg.length;
  return out;
}

/// Second derivatives of v_a^T M^T M v_a over sigma_a^2, the vector fixed. The form is a minimum over the velocity of
/// O, whose response is the last term. `inverse` is that of B^T B + C^T C.
Mat3 curvature(const std::array<Leg, 6>& legs, int a, const Mat3& inverse) {
  Mat3 held = Mat3::Zero(), mixed = Mat3::Zero();
  for (const Leg& leg : legs) {
    const Vec3 &e = leg.direction, t = leg.across.col(a);
    const double rate = leg.rate[a];
    const Mat3 across = Mat3::Identity() - e * e.transpose();
    const Mat3 turned = t * e.transpose();
    held += 2.0 / (leg.length * leg.length) *
            (t * t.transpose() - rate * (turned + turned.transpose()) - rate * rate * across);
    mixed += 2.0 / leg.length * (turned + rate * across);
  }
  return held - 0.5 * mixed * inverse * mixed.transpose();
}

/// The smoothed maximum of `logs`, and the share of each of the six in it.
double soft_largest(const Vec6& logs, double epsilon, Vec6& share) {
  const double largest = logs.maxCoeff();
  share = ((logs.array() - largest) / epsilon).exp();
  const double sum = share.sum();
  share /= sum;
  return largest + epsilon * std::log(sum);
}

/// (e^(power x) - 1) / (e^x - 1)
double power_ratio(double power, double x) {
  return std::abs(x) < 1e-12 ? power : std::expm1(power * x) / std::expm1(x);
}

}  // namespace

Jet soft_condition(const Points& at, const NineLegs& nine, const Spectrum& s, double epsilon) {
  const std::array<Leg, 6> legs = internal_legs(at, nine, s);
  const Vec6 logs = s.sigma.array().log();
  Vec6 top, bottom;
  Jet out;
  out.value = soft_largest(logs, epsilon, top) + soft_largest(-logs, epsilon, bottom);

  Mat3 both = Mat3::Zero();
  for (const Leg& leg : legs) both += leg.direction * leg.direction.transpose();
  const Mat3 inverse = both.inverse();

  Mat36 slope;  // of the logarithms
  for (int a = 0; a < 6; ++a) slope.col(a) = 0.5 * mixed_slope(legs, a, a);
  const Vec3 by_top = slope * top, by_bottom = slope * bottom;
  out.gradient = by_top - by_bottom;
  out.hessian = -(by_top * by_top.transpose() + by_bottom * by_bottom.transpose()) / epsilon;
  for (int a = 0; a < 6; ++a) {
    if (top[a] + bottom[a] < weightless) continue;
    const Vec3 g = slope.col(a);
    const double share = top[a] - bottom[a];
    out.hessian += 0.5 * share * curvature(legs, a, inverse);
    out.hessian += ((top[a] + bottom[a]) / epsilon - 2.0 * share) * (g * g.transpose());
  }
  // Rotation of the singular vectors among each other. In descending order x = log(lambda_b / lambda_a) <= 0.
  const double power = 0.5 / epsilon;
  for (int a = 0; a < 6; ++a)
    for (int b = a + 1; b < 6; ++b) {
      if (top[a] < weightless && bottom[b] < weightless) continue;
      const double x = 2.0 * (logs[b] - logs[a]);
      const double weight =
          top[a] * std::exp(x) * power_ratio(power - 1.0, x) + bottom[b] * power_ratio(power + 1.0, x);
      const Vec3 g = mixed_slope(legs, a, b);
      out.hessian += weight * (g * g.transpose());
    }
  return out;
}

}  // namespace ninedof
