#include "ninedof/conditioning/locked_legs.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>

#include "conditioning/leg_rows.hpp"
#include "conditioning/null_space.hpp"
#include "math/linear/svd6.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

/// M of a locked leg is longer than M along z by 1 / rho.
struct Stretch {
  Vec3 z = Vec3::Zero();  ///< of the lower three rows of M; zero where rho = 1
  double rho = 1.0;
};

/// z of a combination of columns of N with a singular value below 1e-8 stays zero: rho is 1 to the last bit.
Stretch stretch(const Vec3& of_null, const Vec3& of_range) {
  const double d = of_null.norm();
  return {d > 1e-8 ? Vec3(of_null / d) : Vec3::Zero(), of_range.norm()};
}

/// The combinations of two legs whose rows of the range are orthogonal: one Jacobi rotation.
std::array<Stretch, 2> stretches(const Mat36& null, const Mat36& range, Eigen::Index j, Eigen::Index k) {
  const Vec3 a = range.col(j), b = range.col(k);
  const double angle = 0.5 * std::atan2(2.0 * a.dot(b), a.squaredNorm() - b.squaredNorm());
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec3 m = null.col(j), n = null.col(k);
  return {stretch(c * m + s * n, c * a + s * b), stretch(c * n - s * m, c * b - s * a)};
}

/// The part of `v` across a unit vector.
Vec6 across(const Vec6& unit, const Vec6& v) {
  return v - unit.dot(v) * unit;
}

/// M times the least rho, stretched: its singular values in their ratios, without overflow.
Mat6 stretched(Mat6 m, std::span<const Stretch> along) {
  double least = 1.0;
  for (const Stretch& one : along) least = std::min(least, one.rho);
  Mat3 by = least * Mat3::Identity();
  for (const Stretch& one : along) by += (least / one.rho - least) * one.z * one.z.transpose();
  m.topRows<3>() *= least;
  m.bottomRows<3>() = (by * m.bottomRows<3>()).eval();
  return m;
}

}  // namespace

LockedLegs::LockedLegs(const Points& at, const NineLegs& legs, double characteristic_length) {
  require_positive("characteristic_length", characteristic_length);
  const auto [a_e, c, b] = leg_rows(at, legs, characteristic_length);
  m_ = conditioning_rows(a_e, c, b);
  const Vec6 sigma = singular_values_6x6(m_);
  singular_ = sigma[5] <= negligible * sigma[0];
  null_ = null_space(c, b);
  range_ = range_space(c, b);
}

double LockedLegs::relative_manipulability(int leg) const {
  return leg < 3 ? 0.0 : range_.col(leg - 3).norm();
}

double LockedLegs::condition_number(const LegSet& locked) const {
  if (m_.hasNaN() || range_.hasNaN()) return not_a_number;
  if (singular_) return infinity;
  std::array<int, 2> external{}, internal{};
  std::size_t externals = 0, internals = 0;
  for (const int leg : {locked.first, locked.second}) {
    if (leg >= 3) internal[internals++] = leg - 3;
    else if (leg >= 0) external[externals++] = leg;
  }
  std::array<Stretch, 2> along;
  if (internals == 1) along[0] = stretch(null_.col(internal[0]), range_.col(internal[0]));
  if (internals == 2) along = stretches(null_, range_, internal[0], internal[1]);
  for (const Stretch& one : along)
    if (!(one.rho > negligible)) return infinity;
  Mat6 m = stretched(m_, std::span(along).first(internals));
  Vec6 first = Vec6::Zero();
  for (std::size_t k = 0; k < externals; ++k) {  // M on the twists that leave these legs as long as they are
    Vec6 way = m_.row(external[k]).transpose().normalized();
    if (k > 0) way = across(first, across(first, way).normalized()).normalized();  // twice, for its last digits
    m -= (m * way).eval() * way.transpose();
    first = way;
  }
  const Vec6 sigma = singular_values_6x6(m);
  const double least = sigma[locked.freedoms() - 1];
  return least > negligible * sigma[0] ? sigma[0] / least : infinity;
}

Spectrum locked_spectrum(const Points& at, const NineLegs& legs, double lc, int leg) {
  require_positive("characteristic_length", lc);
  const auto [a_e, c, b] = leg_rows(at, legs, lc);
  const Mat36 null = null_space(c, b);
  const Eigen::Index k = leg - 3;
  const Vec3 column = null.col(k);
  const Stretch along = stretch(column, range_space(c, b).col(k));
  Spectrum out;
  out.characteristic_length = lc;
  out.locked = leg;
  if (!(along.rho > negligible)) {
    out.twist = Mat6::Identity();
    out.sdot.setZero();
    out.rates.setZero();
    out.sigma = Vec6::Unit(0) * infinity;
    out.sigma.tail<5>().setZero();
    return out;
  }
  const RightSvd<6> svd = right_svd_6x6(stretched(conditioning_rows(a_e, c, b), {&along, 1}));
  out.sigma = svd.sigma / along.rho;
  out.twist = svd.v;
  const Eigen::Matrix<double, 3, 6> moved = a_e.bottomRows<3>().lazyProduct(svd.v);  // rates of q that sdot makes up
  const Eigen::Matrix<double, 3, 6> left = -null.leftCols<3>().lazyProduct(moved);
  const Eigen::Matrix<double, 1, 6> force = column.transpose().lazyProduct(left) / (along.rho * along.rho);
  const Eigen::LDLT<Mat3> both(c.transpose().lazyProduct(c) + b.transpose().lazyProduct(b));
  const Vec3 own = k < 3 ? Vec3(c.row(k)) : Vec3(b.row(k - 3));
  out.sdot = both.solve(c.transpose().lazyProduct(moved) - own * force);
  out.rates.topRows<3>() = a_e.topRows<3>().lazyProduct(svd.v);
  out.rates.bottomRows<6>() = null.transpose().lazyProduct(left + column * force);
  return out;
}

}  // namespace ninedof
