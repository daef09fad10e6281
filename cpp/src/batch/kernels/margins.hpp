#pragma once
/// The three determinants of singularity.hpp, with the rows of singularity/unit_rows.hpp.

#include "batch/kernels/poses.hpp"
#include "batch/kernels/table.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

template <class P>
struct Margins {
  P n, b, c;
  typename P::Mask sure;  ///< whether no two points nearly coincide
};

/// Squared length of a difference of points, relative to that of the coordinates, above which it has a direction.
constexpr double clear_difference = 1e-26;

/// The unit vector along a; `least` becomes the least squared length so far.
template <class P>
NINEDOF_INLINE Xyz<P> unit(const Xyz<P>& a, P& least) {
  const P squared = dot(a, a);
  least = min(least, squared);
  return (1.0 / sqrt(squared)) * a;
}

/// Never -0.0: a singularity lies on neither side.
template <class P>
NINEDOF_INLINE P determinant(const Xyz<P> (&rows)[3]) {
  return dot(rows[0], cross(rows[1], rows[2])) + 0.0;
}

template <class P>
NINEDOF_INLINE Margins<P> margins(const Joints& g, const Poses<P>& c) {
  P least = 1e300;
  Xyz<P> turning[3], lower[3], upper[3];
  const LegVectors<P> legs(g, c);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const Xyz<P> u = legs.u(i), leg = legs.external(i, u);
    least = min(least, dot(leg, leg));
    turning[i] = cross(unit(c.s - g.base_external[i], least), unit(c.s - (c.p + u), least));
    lower[i] = unit(legs.lower(i), least);
    upper[i] = unit(legs.upper(i), least);
  }
  const double* joint = &g.base_external[0][0];
  double joints = 0.0;
  for (int k = 0; k < 36; ++k) joints += joint[k] * joint[k];
  const P size = dot(c.p, c.p) + dot(c.s, c.s) + joints;
  return {determinant(turning), determinant(lower), determinant(upper), least > clear_difference * size};
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
