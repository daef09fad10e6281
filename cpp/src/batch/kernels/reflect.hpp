#pragma once
/// Householder reflections of a small matrix in every lane, and the reduction of a 6x6 matrix to a bidiagonal one with
/// the same singular values.

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

/// Squares of the entries of a bidiagonal matrix: diagonal q and superdiagonal e.
template <class P>
struct Bidiagonal {
  P q[6], e[5];
};

/// Householder reflections from both sides; `matrix` is overwritten.
template <class P>
NINEDOF_INLINE Bidiagonal<P> bidiagonalize(P (&matrix)[6][6]) {
  Bidiagonal<P> out;
  P* const m = &matrix[0][0];
  out.q[0] = reflect<6, 6, 1, 6>(m);
  out.e[0] = reflect<5, 6, 6, 1>(m + 1);
  out.q[1] = reflect<5, 5, 1, 6>(m + 7);
  out.e[1] = reflect<4, 5, 6, 1>(m + 8);
  out.q[2] = reflect<4, 4, 1, 6>(m + 14);
  out.e[2] = reflect<3, 4, 6, 1>(m + 15);
  out.q[3] = reflect<3, 3, 1, 6>(m + 21);
  // The rest, [f g] above a 2x2 block, needs no reflection: only squares are needed.
  const P a = m[28], b = m[29], c = m[34], d = m[35];
  out.e[3] = square(m[22]) + square(m[23]);
  const auto coupled = out.e[3] > 0.0;
  const P f = select(coupled, m[22], P(1.0)), g = m[23], length2 = select(coupled, out.e[3], P(1.0));
  const P x = a * f + b * g, y = c * f + d * g;  // first column of the rotated block times |[f g]|
  const P cross = x * (b * f - a * g) + y * (d * f - c * g);
  const P first = square(x) + square(y);
  const P inverse = 1.0 / (length2 * first);
  out.q[4] = first * (first * inverse);
  out.e[4] = square(cross) * inverse;
  out.q[5] = square(a * d - b * c) * (square(length2) * inverse);
  return out;
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
