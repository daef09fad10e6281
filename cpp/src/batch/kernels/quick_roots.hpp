#pragma once
/// Extreme eigenvalues of B^T B from the coefficients of its characteristic polynomial (docs/theory/kernels.md).
///
/// The coefficients are sums of products of the squares q_k and e_k of the entries of B, without cancellation. With
/// them p, p' and p'' cost a third of the recurrence of extreme_roots.hpp. But the rounding errors of the coefficients,
/// some units in the last place, change a root by this much times p(-x) / (x p'(x)), which is large close to a second
/// root: there the recurrence is used.

#include "batch/kernels/extreme_roots.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

/// p(x) = x^6 - s_1 x^5 + s_2 x^4 - s_3 x^3 + s_4 x^2 - s_5 x + s_6, with s_k at s[k - 1].
template <class P>
struct Polynomial {
  P s[6];

  /// s_k is the sum of all products of k of the numbers q_1, e_1, q_2, ..., q_6, no two of them adjacent.
  NINEDOF_INLINE explicit Polynomial(const Bidiagonal<P>& b) {
    // The sums for the sequence up to the last number included, and up to the one before it.
    P one[7] = {1.0, b.q[0]}, two[7] = {1.0};
#pragma GCC unroll 10
    for (int j = 1; j < 11; ++j) {
      const P& z = j % 2 == 0 ? b.q[j / 2] : b.e[j / 2];
      const int degree = j / 2 + 1, before = (j + 1) / 2;
      P next[7] = {1.0};
#pragma GCC unroll 6
      for (int k = 1; k <= degree; ++k) {
        const P with = k == 1 ? z : z * two[k - 1];
        next[k] = k <= before ? one[k] + with : with;
      }
#pragma GCC unroll 6
      for (int k = 1; k <= degree; ++k) {
        two[k] = one[k];
        one[k] = next[k];
      }
    }
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) s[k] = one[k + 1];
  }

  /// By Horner's scheme.
  NINEDOF_INLINE Taylor<P> at(const P& x) const {
    const P linear = x - s[0];
    P p2 = 1.0, p1 = x + linear, p = x * linear + s[1];
#pragma GCC unroll 4
    for (int k = 2; k < 6; ++k) {
      p2 = k == 2 ? x + p1 : x * p2 + p1;
      p1 = x * p1 + p;
      p = k % 2 == 0 ? x * p - s[k] : x * p + s[k];
    }
    return {p, p1, p2};
  }

  /// p(-x): the sum of the absolute values of all terms of p(x).
  NINEDOF_INLINE P sizes(const P& x) const {
    P sum = x + s[0];
#pragma GCC unroll 5
    for (int k = 1; k < 6; ++k) sum = x * sum + s[k];
    return sum;
  }
};

/// An iteration towards a root, from outside all roots.
template <class P>
struct Approach {
  P x, last, slope;
  typename P::Mask open;

  /// x did not come from a step of this iteration: at least two steps are made.
  NINEDOF_INLINE explicit Approach(const P& at) : x(at), last(0.0), slope(0.0), open(at >= 0.0) {}

  NINEDOF_INLINE void advance(const Polynomial<P>& p) {
    const Taylor<P> t = p.at(x);
    const P step = t.p * t.p1 / (square(t.p1) - t.p * t.p2);
    x = select(open, x - step, x);
    slope = select(open, t.p1, slope);
    const P size = abs(step);
    // Cubic convergence: the next step is this one times the cube of its ratio to the one before. Ends at rounding.
    open = open & (square(square(size)) > 1e-15 * x * (square(last) * last)) & (size > 1e-13 * x);
    last = size;
  }

  /// Whether the iteration has not converged, or the root is so close to another that the relative rounding of a
  /// coefficient changes it by more than a hundred times as much.
  NINEDOF_INLINE typename P::Mask doubtful(const Polynomial<P>& p) const {
    constexpr double most = 100.0;
    return open | !(p.sizes(x) <= most * (x * abs(slope)));
  }
};

template <class P>
struct Extremes {
  Root<P> least, greatest;
};

template <class P>
NINEDOF_INLINE Extremes<P> extreme_roots(const Bidiagonal<P>& b) {
  constexpr int rounds = 6;  // usually three or four
  const Polynomial<P> p(b);
  const P up = laguerre<6>(Taylor<P>{p.s[5], p.s[4], p.s[3]});
  // The bound of Laguerre and Samuelson, from the mean and the variance of the roots.
  const P mean = p.s[0] * (1.0 / 6.0);
  const P bound = mean + sqrt(max(25.0 * square(mean) - (5.0 / 3.0) * p.s[1], P(0.0)));
  const P down = laguerre<6>(p.at(bound));
  Approach<P> least(up), greatest(bound - down);
  for (int round = 0; round < rounds; ++round) {  // both together: two independent chains of operations
    least.advance(p);
    greatest.advance(p);
    if (!any(least.open | greatest.open)) break;
  }
  Extremes<P> out{{least.x, least.doubtful(p)}, {greatest.x, greatest.doubtful(p)}};
  // Converged lanes keep their root: it must not depend on the other lanes.
  if (any(out.least.open)) {
    const Root<P> again = iterate<6>(b.q, b.e, up, 1.0, P(0.0));
    out.least = {select(out.least.open, again.x, least.x), out.least.open & again.open};
  }
  if (any(out.greatest.open)) {
    const Root<P> again = iterate<6>(b.q, b.e, bound, -1.0, P(0.0));
    out.greatest = {select(out.greatest.open, again.x, greatest.x), out.greatest.open & again.open};
  }
  return out;
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
