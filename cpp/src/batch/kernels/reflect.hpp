#pragma once
/// Householder reflections of a small matrix in every lane.

#include "batch/kernels/pack.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

/// a[0] b[0] + ... + a[n-1] b[n-1], summed as a tree to keep chains of dependent operations short.
template <int n, class P>
NINEDOF_INLINE P product(const P* const (&a)[n], const P* const (&b)[n]) {
  if constexpr (n == 1) {
    return *a[0] * *b[0];
  } else if constexpr (n == 2) {
    return *a[0] * *b[0] + *a[1] * *b[1];
  } else if constexpr (n == 3) {
    return (*a[0] * *b[0] + *a[1] * *b[1]) + *a[2] * *b[2];
  } else if constexpr (n == 4) {
    return (*a[0] * *b[0] + *a[1] * *b[1]) + (*a[2] * *b[2] + *a[3] * *b[3]);
  } else if constexpr (n == 5) {
    return ((*a[0] * *b[0] + *a[1] * *b[1]) + (*a[2] * *b[2] + *a[3] * *b[3])) + *a[4] * *b[4];
  } else {
    return ((*a[0] * *b[0] + *a[1] * *b[1]) + (*a[2] * *b[2] + *a[3] * *b[3])) + (*a[4] * *b[4] + *a[5] * *b[5]);
  }
}

/// Reflects `lines` vectors of n numbers so that the first becomes parallel to the first axis; returns its squared
/// length. Number i of vector j is at m[j * across + i * along]. The first vector is not updated.
template <int n, int lines, int across, int along, class P>
NINEDOF_INLINE P reflect(P* m) {
  const P* x[n];
#pragma GCC unroll 6
  for (int i = 0; i < n; ++i) x[i] = m + i * along;
  const P squared = product<n>(x, x);
  P dots[lines];
#pragma GCC unroll 6
  for (int j = 1; j < lines; ++j) {
    const P* y[n];
#pragma GCC unroll 6
    for (int i = 0; i < n; ++i) y[i] = m + j * across + i * along;
    dots[j] = product<n>(x, y);
  }
  const P length = copysign(sqrt(squared), m[0]);
  // A zero vector is not reflected.
  const P scale = select(squared > 0.0, 1.0 / (squared + length * m[0]), P(0.0));
  const P head = m[0] + length;
#pragma GCC unroll 6
  for (int j = 1; j < lines; ++j) {
    const P t = (dots[j] + length * m[j * across]) * scale;
    m[j * across] -= t * head;
#pragma GCC unroll 6
    for (int i = 1; i < n; ++i) m[j * across + i * along] -= t * m[i * along];
  }
  return squared;
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
