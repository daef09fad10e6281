#include "ninedof/conditioning/sensitivity.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

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
  Mat6 e;  // rows of A, then of E
  Mat3 b, c;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &external = legs.direction[at_index(i)], &upper = legs.direction[at_index(i + 3)];
    const Vec3 u = at[at_index(point_u + i)] - at[point_p], u_tilde = at[at_index(point_u_tilde + i)] - at[point_p];
    e.row(i) << u.cross(external).transpose() / lc, external.transpose();
    e.row(i + 3) << u_tilde.cross(upper).transpose() / lc, upper.transpose();
    c.row(i) = upper;
    b.row(i) = legs.direction[at_index(i + 6)];
  }
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
  for (int k = 0; k < 9; ++k) {
    if (a == b) {
      add_rate_gradient(at, legs, k, s.twist.col(a), s.sdot.col(a), s.rates(k, a), 2.0 * scale * s.rates(k, a),
                        s.characteristic_length, out);
      continue;
    }
    add_rate_gradient(at, legs, k, s.twist.col(a), s.sdot.col(a), s.rates(k, a), scale * s.rates(k, b),
                      s.characteristic_length, out);
    add_rate_gradient(at, legs, k, s.twist.col(b), s.sdot.col(b), s.rates(k, b), scale * s.rates(k, a),
                      s.characteristic_length, out);
  }
}

}  // namespace ninedof
