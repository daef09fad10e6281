#pragma once
/// The three determinants of singularity.hpp.

#include "batch/kernels/poses.hpp"
#include "batch/kernels/table.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

template <class P>
struct Margins {
  P m, b, c;
  typename P::Mask sure;  ///< no two points nearly coincide
};

/// Squared length of a difference of points, in terms of the squared size of the coordinates, that has a direction beyond doubt.
constexpr double clear_difference = 1e-26;

/// The unit vector along a; `least` keeps the least squared length.
template <class P>
NINEDOF_INLINE Vector<P> unit(const Vector<P>& a, P& least) {
  const P squared = dot(a, a);
  least = min(least, squared);
  return a * (1.0 / sqrt(squared));
}

/// No -0.0: at a singularity there is no side.
template <class P>
NINEDOF_INLINE P determinant(const Vector<P> (&rows)[3]) {
  return dot(rows[0], cross(rows[1], rows[2])) + 0.0;
}

template <class P>
NINEDOF_INLINE Margins<P> margins(const Joints& g, const Poses<P>& c) {
  P least = 1e300;
  Vector<P> turning[3], lower[3], upper[3];
  const Vector<P> y = c.s - c.p;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const Vector<P> tip = c.p + c.turned(g.platform_external[i]);
    const Vector<P> leg = tip - g.base_external[i];
    least = min(least, dot(leg, leg));
    turning[i] = cross(unit(c.s - g.base_external[i], least), unit(c.s - tip, least));
    lower[i] = unit(c.s - g.base_internal[i], least);
    upper[i] = unit(y - c.turned(g.platform_internal[i]), least);
  }
  const double* joint = &g.base_external[0][0];
  double joints = 0.0;
  for (int k = 0; k < 36; ++k) joints += joint[k] * joint[k];
  const P size = dot(c.p, c.p) + dot(c.s, c.s) + joints;
  return {determinant(turning), determinant(lower), determinant(upper), least > clear_difference * size};
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
