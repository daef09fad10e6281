#include "ninedof/conditioning/sensitivity.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "conditioning/leg_rows.hpp"
#include "conditioning/null_space.hpp"
#include "math/linear/svd6.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

/// Velocity of the upper end of leg k relative to its lower end.
Vec3 relative_velocity(const Points& at, int k, const Vec3& omega, const Vec3& pdot, const Vec3& sdot) {
  const LegEnds ends = leg_ends(k);
  if (k < 3) return pdot + omega.cross(at[at_index(ends.to)] - at[point_p]);
  if (k < 6) return sdot - pdot - omega.cross(at[at_index(ends.from)] - at[point_p]);
  return sdot;
}

/// Adds weight * d(rate of leg k), with twist and sdot held fixed.
void add_rate_gradient(const Points& at, const NineLegs& legs, int k, const Vec6& twist, const Vec3& sdot, double rate,
                       double weight, double lc, PointGradient& out) {
  const LegEnds ends = leg_ends(k);
  const Vec3& e = legs.direction[at_index(k)];
  const double length = legs.length[k];
  if (!(length > 0.0)) return;
  const Vec3 omega = twist.head<3>() / lc;
  const Vec3 velocity = relative_velocity(at, k, omega, twist.tail<3>(), sdot);
  const Vec3 turning = (weight / length) * (velocity - rate * e);
  out.point[at_index(ends.to)] += turning;
  out.point[at_index(ends.from)] -= turning;
  if (k >= 6) return;
  // The lever of the platform joint about p.
  const double sign = k < 3 ? weight : -weight;
  const int joint = k < 3 ? ends.to : ends.from;
  const Vec3 lever = sign * e.cross(omega);
  out.point[at_index(joint)] += lever;
  out.point[point_p] -= lever;
  out.length -= (at[at_index(joint)] - at[point_p]).dot(lever) / lc;
}

}  // namespace

Spectrum spectrum(const Points& at, const NineLegs& legs, double lc) {
  require_positive("characteristic_length", lc);
  const auto [e, c, b] = leg_rows(at, legs, lc);
  const RightSvd<6> svd = right_svd_6x6(conditioning_rows(e, c, b));
  Spectrum out;
  out.sigma = svd.sigma;
  out.twist = svd.v;
  out.characteristic_length = lc;
  const Eigen::Matrix<double, 3, 6> pulled = c.transpose().lazyProduct(e.bottomRows<3>().lazyProduct(svd.v));
  const Eigen::LDLT<Mat3> both(c.transpose().lazyProduct(c) + b.transpose().lazyProduct(b));
  out.sdot = both.solve(pulled);
  out.rates.topRows<3>() = e.topRows<3>().lazyProduct(svd.v);
  out.rates.middleRows<3>(3) = c.lazyProduct(out.sdot) - e.bottomRows<3>().lazyProduct(svd.v);
  out.rates.bottomRows<3>() = b.lazyProduct(out.sdot);
  return out;
}

PointGradient zero_gradient() {
  PointGradient out;
  for (Vec3& g : out.point) g.setZero();
  out.length = 0.0;
  return out;
}

void add_spectrum_gradient(const Points& at, const NineLegs& legs, const Spectrum& s, int a, int b, double scale,
                           PointGradient& out) {
  const auto add = [&](int k, int of, double weight) {
    const double rate = k == s.locked ? 0.0 : s.rates(k, of);
    add_rate_gradient(at, legs, k, s.twist.col(of), s.sdot.col(of), rate, weight, s.characteristic_length, out);
  };
  for (int k = 0; k < 9; ++k) {
    if (a == b) {
      add(k, a, 2.0 * scale * s.rates(k, a));
      continue;
    }
    add(k, a, scale * s.rates(k, b));
    add(k, b, scale * s.rates(k, a));
  }
}

}  // namespace ninedof
