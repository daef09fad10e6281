#pragma once
/// Transposes rows of numbers in memory to columns and back: lane k of column j is number j of row k.

#include "batch/kernels/pack.hpp"
#include "batch/kernels/poses.hpp"
#include "batch/kernels/table.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

/// Number of rows transposed at a time: a multiple of the pack size, and their columns fit the first-level cache.
constexpr long chunk = 64;

using Two = double __attribute__((vector_size(16)));

/// The columns of `rows` rows; the last row is repeated to fill the chunk.
template <int width>
NINEDOF_INLINE void gather(const double* from, long step, long rows, double (*column)[chunk]) {
  if (step == 0) {
    for (int j = 0; j < width; ++j)
      for (long k = 0; k < chunk; ++k) column[j][k] = from[j];
    return;
  }
  // Two rows and two columns at a time need half the stores.
  for (long k = 0; k < chunk; k += 2) {
    const double* one = from + (k < rows ? k : rows - 1) * step;
    const double* two = from + (k + 1 < rows ? k + 1 : rows - 1) * step;
#pragma GCC unroll 4
    for (int j = 0; j + 1 < width; j += 2) {
      const Two a = vector_at<Two>(one + j), b = vector_at<Two>(two + j);
      put_vector(Two{a[0], b[0]}, &column[j][k]);
      put_vector(Two{a[1], b[1]}, &column[j + 1][k]);
    }
    if constexpr (width % 2 == 1) put_vector(Two{one[width - 1], two[width - 1]}, &column[width - 1][k]);
  }
}

/// Prefetches rows while the chunk before them is computed.
NINEDOF_INLINE void prefetch(const double* from, long step, long rows) {
  constexpr long line = 64 / sizeof(double);
  for (long k = 0; k < rows * step; k += line) __builtin_prefetch(from + k);
}

/// A chunk of configurations as columns: position, rotation, internal point, characteristic length.
struct Columns {
  alignas(64) double x[16][chunk];

  NINEDOF_INLINE void gather_block(const Block& b, long first, long rows) {
    gather<3>(b.position + first * b.position_step, b.position_step, rows, x);
    gather<9>(b.rotation + first * b.rotation_step, b.rotation_step, rows, x + 3);
    gather<3>(b.internal_point + first * b.internal_point_step, b.internal_point_step, rows, x + 12);
  }
  NINEDOF_INLINE static void prefetch_block(const Block& b, long first, long rows) {
    prefetch(b.position + first * b.position_step, b.position_step, rows);
    prefetch(b.rotation + first * b.rotation_step, b.rotation_step, rows);
    prefetch(b.internal_point + first * b.internal_point_step, b.internal_point_step, rows);
  }
  NINEDOF_INLINE void gather_length(const Block& b, long first, long rows) {
    gather<1>(b.length + first * b.length_step, b.length_step, rows, x + 15);
  }

  template <class P>
  NINEDOF_INLINE Poses<P> poses(long k) const {
    Poses<P> c;
    c.p = {P::load(x[0] + k), P::load(x[1] + k), P::load(x[2] + k)};
#pragma GCC unroll 9
    for (int j = 0; j < 9; ++j) c.q[j] = P::load(x[3 + j] + k);
    c.s = {P::load(x[12] + k), P::load(x[13] + k), P::load(x[14] + k)};
    return c;
  }
  template <class P>
  NINEDOF_INLINE P length(long k) const {
    return P::load(x[15] + k);
  }
};

/// Columns back to rows.
template <int width>
NINEDOF_INLINE void scatter(const double (*column)[chunk], long rows, double* to) {
  for (long k = 0; k < rows; ++k)
#pragma GCC unroll 9
    for (int j = 0; j < width; ++j) to[k * width + j] = column[j][k];
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
