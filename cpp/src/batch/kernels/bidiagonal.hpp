#pragma once
/// Reduces a 6x6 matrix to a bidiagonal one with the same singular values.

#include "batch/kernels/reflect.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

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
