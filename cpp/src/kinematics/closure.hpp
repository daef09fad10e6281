#pragma once
/// The three 3x3 systems from leg rates to velocities and on to accelerations (docs/theory/velocity.md).
///
/// They are the derivatives of the squared lengths x_i.x_i = l_i^2, y_i.y_i = q_i^2, z_i.z_i = r_i^2. Without unit
/// vectors a leg of zero length is no special case: it gives a row of zeros and a singular system.
///
///     z_i.sdot = r_i rdot_i
///     y_i.h    = q_i qdot_i              h = sdot - v_O,  v_O = pdot + omega x y: the platform point at O
///     n_i.omega = l_i ldot_i - x_i.v_O   n_i = w_i x x_i,  w_i from O to platform joint i
///
/// The second derivatives have the same matrices, for sddot, k = sddot - a_O and alpha, and other right sides.

#include <algorithm>
#include <array>

#include "math/linear/cramer.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"
#include "robot/leg_vectors.hpp"

namespace ninedof {

/// Leg vectors and lengths. Lane 0 holds a lower internal leg, lane 1 the upper one: their systems are solved together.
struct Closure {
  Xyz<double> y;                         ///< O seen from p
  std::array<Xyz<double>, 3> x, w;       ///< external legs; platform joints seen from O
  std::array<Xyz<Lanes>, 3> internal;    ///< z_i and y_i
  std::array<double, 3> length;          ///< l_i
  double per_area;                       ///< 1 / (l_1^2 + l_2^2 + l_3^2)
  std::array<Lanes, 3> internal_length;  ///< r_i and q_i
};

/// Whether a leg, or the way from O to an external joint, is so short that rounding has eaten its digits.
EIGEN_ALWAYS_INLINE bool has_short_vector(const Closure& k, const Lanes& two, double third) {
  const auto& rq = k.internal_length;
  const Lanes low = rq[0].min(rq[1]).min(rq[2]), high = rq[0].max(rq[1]).max(rq[2]);
  const double w = std::min({dot(k.w[0], k.w[0]), dot(k.w[1], k.w[1]), dot(k.w[2], k.w[2])});
  const double longest = high.maxCoeff();
  return std::min({low.square().minCoeff(), two.minCoeff(), third, w}) <= short_leg * (longest * longest);
}

/// Forms the short ones again, with all their digits.
void mend_short_vectors(const Geometry& g, const Configuration& c, Closure& k);

EIGEN_ALWAYS_INLINE Closure closure(const Geometry& g, const Configuration& c) {
  Closure k;
  const Vec3& s = c.internal_point;
  const Vec3 y = s - c.position;
  k.y = xyz(y);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 u = c.rotation * g.platform_external()[i], u_tilde = c.rotation * g.platform_internal()[i];
    const Vec3& r_hat = g.base_internal()[i];
    k.x[i] = xyz(external_leg(c, u, g.base_external()[i]));
    k.w[i] = xyz(u - y);
    // lower_leg() and upper_leg() in two lanes: one subtraction for both.
    k.internal[i] = {Lanes(s[0], y[0]) - Lanes(r_hat[0], u_tilde[0]), Lanes(s[1], y[1]) - Lanes(r_hat[1], u_tilde[1]),
                     Lanes(s[2], y[2]) - Lanes(r_hat[2], u_tilde[2])};
    k.internal_length[i] = dot(k.internal[i], k.internal[i]).sqrt();
  }
  Lanes two(dot(k.x[0], k.x[0]), dot(k.x[1], k.x[1]));
  double third = dot(k.x[2], k.x[2]);
  if (has_short_vector(k, two, third)) [[unlikely]] {
    mend_short_vectors(g, c, k);
    two = {dot(k.x[0], k.x[0]), dot(k.x[1], k.x[1])};
    third = dot(k.x[2], k.x[2]);
  }
  k.per_area = 1.0 / (two.sum() + third);
  const Lanes roots = two.sqrt();
  k.length = {roots[0], roots[1], std::sqrt(third)};
  return k;
}

/// The three systems, factored once for any number of right sides.
class ClosureSolver {
 public:
  EIGEN_ALWAYS_INLINE ClosureSolver(const Geometry& g, const Configuration& c)
      : legs(closure(g, c)),
        internal_(legs.internal[0], legs.internal[1], legs.internal[2]),
        external_(legs.per_area * cross(legs.w[0], legs.x[0]), legs.per_area * cross(legs.w[1], legs.x[1]),
                  legs.per_area * cross(legs.w[2], legs.x[2])) {}

  const Closure legs;

  struct Solution {
    Xyz<double> o;        ///< sdot, or sddot
    Xyz<double> slip;     ///< h, or k
    Xyz<double> at_o;     ///< v_O, or a_O
    Xyz<double> angular;  ///< omega, or alpha
  };

  /// `internal`: right sides of the rows z_i and y_i; `external`: of n_i before x_i.v_O is subtracted.
  EIGEN_ALWAYS_INLINE Solution solve(const std::array<Lanes, 3>& internal,
                                     const std::array<double, 3>& external) const {
    const Xyz<Lanes> both = internal_.solve(internal[0], internal[1], internal[2]);
    Solution v;
    v.o = lane(both, 0);
    v.slip = lane(both, 1);
    v.at_o = v.o - v.slip;
    const auto right = [&](std::size_t i) { return legs.per_area * (external[i] - dot(legs.x[i], v.at_o)); };
    v.angular = external_.solve(right(0), right(1), right(2));
    return v;
  }

  /// The velocities for given leg rates.
  EIGEN_ALWAYS_INLINE Solution velocity(const Vec9& rates) const {
    const auto internal = [&](std::size_t i) { return Lanes(legs.internal_length[i] * lower_upper(rates, i)); };
    const auto external = [&](std::size_t i) { return legs.length[i] * rates[static_cast<Eigen::Index>(i)]; };
    return solve({internal(0), internal(1), internal(2)}, {external(0), external(1), external(2)});
  }

  /// The values of internal legs i, from those of nine legs.
  EIGEN_ALWAYS_INLINE static Lanes lower_upper(const Vec9& of_legs, std::size_t i) {
    const auto k = static_cast<Eigen::Index>(i);
    return {of_legs[k + 6], of_legs[k + 3]};
  }

  /// Inverses of the matrices Z, Y and N0 with rows z_i, y_i and n_i.
  Mat3 z_inverse() const { return internal_inverse(0); }
  Mat3 y_inverse() const { return internal_inverse(1); }
  Mat3 n_inverse() const {
    return columns([&](std::size_t k) { return external_.column(k, legs.per_area); });
  }

 private:
  Mat3 internal_inverse(Eigen::Index of) const {
    return columns([&](std::size_t k) { return lane(internal_.column(k, Lanes::Ones()), of); });
  }
  static Mat3 columns(const auto& column) {
    Mat3 m;
    m << vec3(column(0)), vec3(column(1)), vec3(column(2));
    return m;
  }

  Cramer<Lanes> internal_;
  Cramer<double> external_;
};

}  // namespace ninedof
