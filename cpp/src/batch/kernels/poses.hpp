#pragma once
/// Vectors and configurations, one in each lane.

#include "batch/kernels/pack.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

template <class P>
struct Vector {
  P x, y, z;
};

template <class P>
NINEDOF_INLINE Vector<P> operator+(const Vector<P>& a, const Vector<P>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class P>
NINEDOF_INLINE Vector<P> operator-(const Vector<P>& a, const Vector<P>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class P>
NINEDOF_INLINE Vector<P> operator-(const Vector<P>& a, const double (&b)[3]) {
  return {a.x - b[0], a.y - b[1], a.z - b[2]};
}
template <class P>
NINEDOF_INLINE Vector<P> operator*(const Vector<P>& a, const P& b) {
  return {a.x * b, a.y * b, a.z * b};
}
template <class P>
NINEDOF_INLINE P dot(const Vector<P>& a, const Vector<P>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class P>
NINEDOF_INLINE Vector<P> cross(const Vector<P>& a, const Vector<P>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The unit vectors along three legs. Three square roots, but one division.
template <class P>
NINEDOF_INLINE void normalize(Vector<P> (&legs)[3]) {
  const P a = sqrt(dot(legs[0], legs[0])), b = sqrt(dot(legs[1], legs[1])), c = sqrt(dot(legs[2], legs[2]));
  const P ab = a * b;
  const P inverse = 1.0 / (ab * c);
  const P by_ab = inverse * c;
  legs[0] = legs[0] * (by_ab * b);
  legs[1] = legs[1] * (by_ab * a);
  legs[2] = legs[2] * (inverse * ab);
}

/// Position, rotation (row-major) and internal point.
template <class P>
struct Poses {
  Vector<P> p;
  P q[9];
  Vector<P> s;

  /// Q a
  NINEDOF_INLINE Vector<P> turned(const double (&a)[3]) const {
    return {q[0] * a[0] + q[1] * a[1] + q[2] * a[2], q[3] * a[0] + q[4] * a[1] + q[5] * a[2],
            q[6] * a[0] + q[7] * a[1] + q[8] * a[2]};
  }
};

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
