#pragma once
/// All eigenvalues of B^T B for a bidiagonal B, in ascending order (docs/theory/kernels.md).
///
/// The least root is subtracted, except for its rounding error, as a shift of the differential quotient-difference
/// transform. Two more transforms separate the remainder, the last quotient then, and the root is deflated.

#include "batch/kernels/extreme_roots.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

/// One transform with shift x; returns the last quotient.
template <int n, class P>
NINEDOF_INLINE P transform(P* q, P* e, const P& x) {
  P d = q[0] - x;
#pragma GCC unroll 5
  for (int k = 0; k < n - 1; ++k) {
    q[k] = d + e[k];
    const P ratio = q[k + 1] / q[k];
    e[k] = e[k] * ratio;
    d = d * ratio - x;
  }
  q[n - 1] = d;
  return d;
}

template <int n, class P>
NINEDOF_INLINE void roots_from(P* q, P* e, const P& shift, P* out, typename P::Mask& open) {
  if constexpr (n == 1) {
    out[0] = shift + q[0];
  } else {
    const Root<P> least = least_root<n>(q, e);
    open = open | least.open;
    const P most = least.x * (1.0 - 4e-15);
    P rest = transform<n>(q, e, most);
    q[n - 1] = max(rest, P(0.0));
    transform<n>(q, e, P(0.0));
    rest = transform<n>(q, e, P(0.0));
    const P root = (shift + most) + rest;
    // The neglected coupling, relative to the root.
    open = open | (e[n - 2] > 1e-16 * root);
    out[0] = root;
    roots_from<n - 1>(q, e, shift + most, out + 1, open);
  }
}

template <class P>
struct Roots {
  P x[6];
  typename P::Mask open;
};

/// If B decouples in the middle, a root may appear in another place than the last, and the others become wrong. The
/// sums of the roots and of their reciprocals, and their order, detect this.
template <class P>
NINEDOF_INLINE Roots<P> all_roots(Bidiagonal<P> b) {
  const Taylor<P> zero = characteristic_at_zero<6>(b.q, b.e);
  P trace = b.q[0];
#pragma GCC unroll 5
  for (int k = 0; k < 5; ++k) trace += b.q[k + 1] + b.e[k];
  Roots<P> out;
  out.open = trace < 0.0;  // false in every lane
  roots_from<6>(b.q, b.e, P(0.0), out.x, out.open);
  P sum = 0.0, reciprocals = 0.0;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    sum += out.x[k];
    reciprocals += 1.0 / out.x[k];
    if (k > 0) out.open = out.open | (out.x[k] < (1.0 - 1e-14) * out.x[k - 1]);
  }
  const P inverse_trace = -zero.p1 / zero.p;
  out.open = out.open | (abs(sum - trace) > 1e-14 * trace) | (abs(reciprocals - inverse_trace) > 1e-14 * inverse_trace);
  return out;
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
