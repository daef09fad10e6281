#pragma once
/// Configurations and their leg vectors, one per lane.

#include "batch/kernels/pack.hpp"
#include "batch/kernels/table.hpp"
#include "ninedof/math/xyz.hpp"
#include "robot/short_leg.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

template <class P>
NINEDOF_INLINE Xyz<P> operator-(const Xyz<P>& a, const double (&b)[3]) {
  return {a.x - b[0], a.y - b[1], a.z - b[2]};
}

/// The least and the greatest squared length of legs.
template <class P>
struct SquaredLengths {
  P least = 1e300, greatest = 0.0;

  NINEDOF_INLINE P of(const Xyz<P>& leg) {
    const P squared = dot(leg, leg);
    least = min(squared, least);
    greatest = max(squared, greatest);
    return squared;
  }
  /// Whether no leg is so short that rounding has eaten its digits.
  NINEDOF_INLINE typename P::Mask clear() const { return least > short_leg * greatest; }
};

/// The unit vectors along three legs, with three square roots and one division.
template <class P>
NINEDOF_INLINE void normalize(Xyz<P> (&legs)[3], SquaredLengths<P>& lengths) {
  const P a = sqrt(lengths.of(legs[0])), b = sqrt(lengths.of(legs[1])), c = sqrt(lengths.of(legs[2]));
  const P ab = a * b;
  const P inverse = 1.0 / (ab * c);
  const P by_ab = inverse * c;
  legs[0] = (by_ab * b) * legs[0];
  legs[1] = (by_ab * a) * legs[1];
  legs[2] = (inverse * ab) * legs[2];
}

/// Position, rotation (row-major) and internal point.
template <class P>
struct Poses {
  Xyz<P> p;
  P q[9];
  Xyz<P> s;

  /// Q a
  NINEDOF_INLINE Xyz<P> turned(const double (&a)[3]) const {
    return {q[0] * a[0] + q[1] * a[1] + q[2] * a[2], q[3] * a[0] + q[4] * a[1] + q[5] * a[2],
            q[6] * a[0] + q[7] * a[1] + q[8] * a[2]};
  }
};

/// The legs as vectors, as in robot/leg_vectors.hpp. Each is formed when it is needed: with all nine in registers at
/// once the leg lengths take 1.2 times as long.
template <class P>
struct LegVectors {
  const Joints& joints;
  const Poses<P>& pose;
  Xyz<P> y;  ///< s - p

  NINEDOF_INLINE LegVectors(const Joints& g, const Poses<P>& c) : joints(g), pose(c), y(c.s - c.p) {}

  /// Q u_i
  NINEDOF_INLINE Xyz<P> u(int i) const { return pose.turned(joints.platform_external[i]); }
  /// For u = Q u_i.
  NINEDOF_INLINE Xyz<P> external(int i, const Xyz<P>& u) const { return pose.p + u - joints.base_external[i]; }
  NINEDOF_INLINE Xyz<P> upper(int i) const { return y - pose.turned(joints.platform_internal[i]); }
  NINEDOF_INLINE Xyz<P> lower(int i) const { return pose.s - joints.base_internal[i]; }
};

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
