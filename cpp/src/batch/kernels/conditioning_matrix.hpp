#pragma once
/// The conditioning matrix M, whose singular values are the reciprocals of those of J' (docs/theory/kernels.md).
///
/// E t = C v_O with v_O = pdot + omega x y, y = s - p. So the lower rows of M are w -> [y x w / l_c, w] for the rows w
/// of W = N_q C, and a QR factorization of [C C; B 0] leaves this W below the diagonal block.

#include "batch/kernels/poses.hpp"
#include "batch/kernels/reflect.hpp"
#include "batch/kernels/table.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

/// W = N_q C from the rows of C and B; W^T W = ((C^T C)^-1 + (B^T B)^-1)^-1 where the inverses exist.
template <class P>
NINEDOF_INLINE void shared_rows(const Xyz<P> (&c)[3], const Xyz<P> (&b)[3], Xyz<P> (&w)[3]) {
  P m[6][6];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    m[i][0] = m[i][3] = c[i].x;
    m[i][1] = m[i][4] = c[i].y;
    m[i][2] = m[i][5] = c[i].z;
    m[i + 3][0] = b[i].x;
    m[i + 3][1] = b[i].y;
    m[i + 3][2] = b[i].z;
    m[i + 3][3] = m[i + 3][4] = m[i + 3][5] = 0.0;
  }
  reflect<6, 6, 1, 6>(&m[0][0]);
  reflect<5, 5, 1, 6>(&m[1][1]);
  reflect<4, 4, 1, 6>(&m[2][2]);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) w[i] = {m[i + 3][3], m[i + 3][4], m[i + 3][5]};
}

template <class P>
NINEDOF_INLINE void set_row(P (&row)[6], const Xyz<P>& turning, const Xyz<P>& moving) {
  row[0] = turning.x;
  row[1] = turning.y;
  row[2] = turning.z;
  row[3] = moving.x;
  row[4] = moving.y;
  row[5] = moving.z;
}

template <class P>
NINEDOF_INLINE void conditioning_matrix(const Joints& g, const Poses<P>& c, const P& inverse_lc, P (&m)[6][6]) {
  const LegVectors<P> legs(g, c);
  Xyz<P> u[3], external[3], upper[3], lower[3], w[3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    u[i] = legs.u(i);
    external[i] = legs.external(i, u[i]);
    upper[i] = legs.upper(i);
    lower[i] = legs.lower(i);
  }
  SquaredLengths<P> lengths;
  normalize(upper, lengths);
  normalize(lower, lengths);
  normalize(external, lengths);
  const P factor = select(lengths.clear(), inverse_lc, P(__builtin_nan("")));  // makes the row unsure
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) set_row(m[i], factor * cross(u[i], external[i]), external[i]);
  shared_rows(upper, lower, w);
  const Xyz<P> lever = factor * legs.y;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) set_row(m[i + 3], cross(lever, w[i]), w[i]);
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
