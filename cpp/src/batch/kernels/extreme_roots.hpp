#pragma once
/// Least and greatest eigenvalue of B^T B for a bidiagonal B, without forming the product (docs/theory/kernels.md).
///
/// The characteristic polynomial is evaluated from the squares q_k and e_k of the entries of B, without division and
/// without the cancellation that B^T B would bring,
///
///   v_1 = 1, u_1 = q_1 - x,    v_{k+1} = u_k + e_k v_k,    u_{k+1} = q_{k+1} u_k - x v_{k+1},    p(x) = u_6
///
/// (the differential quotient-difference transform with numerators and denominators of its quotients kept apart). Small
/// roots are therefore as accurate as B. The iterations go up from 0 to the least root and down from an upper bound to
/// the greatest root: monotonically, because all roots are real, and with cubic convergence at a simple root.

#include "batch/kernels/reflect.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

/// p(x), p'(x) and p''(x) / 2.
template <class P>
struct Taylor {
  P p, p1, p2;
};

template <int n, class P>
NINEDOF_INLINE Taylor<P> characteristic(const P* q, const P* e, const P& x) {
  P u = q[0] - x, u1 = -1.0, u2 = 0.0;
  P v = 1.0, v1 = 0.0, v2 = 0.0;
#pragma GCC unroll 5
  for (int k = 0; k < n - 1; ++k) {
    v = k == 0 ? u + e[k] : u + e[k] * v;
    v1 = k == 0 ? u1 : u1 + e[k] * v1;
    v2 = k == 0 ? P(0.0) : k == 1 ? u2 : u2 + e[k] * v2;
    u2 = k == 0 ? -v1 : q[k + 1] * u2 - v1 - x * v2;
    u1 = q[k + 1] * u1 - v - x * v1;
    u = q[k + 1] * u - x * v;
  }
  return {u, u1, u2};
}

template <int n, class P>
NINEDOF_INLINE Taylor<P> characteristic_at_zero(const P* q, const P* e) {
  P u = q[0], u1 = -1.0, u2 = 0.0;
  P v = 1.0, v1 = 0.0;
#pragma GCC unroll 5
  for (int k = 0; k < n - 1; ++k) {
    v = k == 0 ? u + e[0] : u + e[k] * v;
    v1 = k == 0 ? u1 : u1 + e[k] * v1;
    u2 = k == 0 ? -v1 : q[k + 1] * u2 - v1;
    u1 = q[k + 1] * u1 - v;
    u = q[k + 1] * u;
  }
  return {u, u1, u2};
}

/// Size of Laguerre's step from a point outside all roots to the nearest one.
template <int n, class P>
NINEDOF_INLINE P laguerre(const Taylor<P>& t) {
  constexpr double slope = (n - 1) * (n - 1), bend = 2 * n * (n - 1);
  const P root = sqrt(max(slope * square(t.p1) - bend * (t.p * t.p2), P(0.0)));
  return double(n) * t.p / (abs(t.p1) + root);
}

/// Size of Halley's step: close to a simple root as good as Laguerre's, and without the square root.
template <class P>
NINEDOF_INLINE P halley(const Taylor<P>& t) {
  return abs(t.p * t.p1 / (square(t.p1) - t.p * t.p2));
}

template <class P>
struct Root {
  P x;
  typename P::Mask open;  ///< not converged
};

constexpr int most_rounds = 40;  // usually four to six; up to thirty for a multiple root

/// Iterates from x in one direction. `last` is the step that led to x, 0 if x is only a bound: then two steps at least.
template <int n, class P>
NINEDOF_INLINE Root<P> iterate(const P* q, const P* e, P x, double direction, P last) {
  typename P::Mask open = x >= 0.0;
  for (int round = 0; round < most_rounds; ++round) {
    const P step = halley(characteristic<n>(q, e, x));
    x = select(open, x + direction * step, x);
    // With cubic convergence the next step is this one times the cube of its ratio to the step before; with slow
    // convergence, to a multiple root, the steps end as rounding. Converged lanes keep their root: it must not
    // depend on the other lanes.
    open = open &
           ((square(square(step)) > 1e-15 * x * (square(last) * last)) | ((step > 0.1 * last) & (step > 4e-15 * x)));
    if (!any(open)) break;
    last = step;
  }
  return {x, open};
}

template <int n, class P>
NINEDOF_INLINE Root<P> least_root(const P* q, const P* e) {
  const P first = laguerre<n>(characteristic_at_zero<n>(q, e));
  return iterate<n>(q, e, first, 1.0, first);
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
