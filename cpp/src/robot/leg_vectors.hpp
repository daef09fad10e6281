#pragma once
/// The legs as vectors: where p + Q u - r is formed for numbers of type double.
///
/// The closed form on the axis (conditioning/symmetric.hpp) and the batch kernels (batch/kernels/poses.hpp) form the
/// same vectors over their own number types. points.hpp starts from the joints as points in the base frame, with
/// respect to which it differentiates: s - (p + Q u~) there and (s - p) - Q u~ here differ by rounding.
///
/// One leg at a time and always inlined: with all nine in a struct forward velocity takes 1.9 times as long.

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "robot/short_leg.hpp"

namespace ninedof {

/// p + u - r (11), for u = Q u_i.
EIGEN_ALWAYS_INLINE Vec3 external_leg(const Configuration& c, const Vec3& u, const Vec3& r) {
  return c.position + u - r;
}

/// s - r^ (12).
EIGEN_ALWAYS_INLINE Vec3 lower_leg(const Configuration& c, const Vec3& r_hat) {
  return c.internal_point - r_hat;
}

/// s - p - u~ (13), for u~ = Q u~_i.
EIGEN_ALWAYS_INLINE Vec3 upper_leg(const Configuration& c, const Vec3& u_tilde) {
  return c.internal_point - c.position - u_tilde;
}

/// to - from - Q joint with the error of one rounding, however much of it cancels: for short legs.
Vec3 exact_leg(const Vec3& to, const Vec3& from, const Mat3& rotation, const Vec3& joint);

}  // namespace ninedof
