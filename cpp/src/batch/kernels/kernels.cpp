/// The kernels, compiled once for each instruction set.
/// Declared in batch/kernels/table.hpp.

#include "batch/kernels/all_roots.hpp"
#include "batch/kernels/conditioning_matrix.hpp"
#include "batch/kernels/gather.hpp"
#include "batch/kernels/hexagonal.hpp"
#include "batch/kernels/margins.hpp"
#include "batch/kernels/quick_roots.hpp"
#include "batch/kernels/spectra.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {
namespace {

/// Two registers: two independent chains of operations at a time. No result depends on the number of lanes.
using Lanes = PackOf<2 * per_register>;

/// Calls work(columns, first, rows) for each chunk.
template <class Work>
NINEDOF_INLINE void for_each_chunk(const Block& b, const Work& work) {
  Columns c;
  for (long first = 0; first < b.count; first += chunk) {
    const long rows = b.count - first < chunk ? b.count - first : chunk;
    c.gather_block(b, first, rows);
    work(c, first, rows);
  }
}

/// Squares of the entries of the bidiagonal form of M, by column: q, then e.
struct Bidiagonals {
  alignas(64) double x[11][chunk];

  /// Also prefetches the configurations of the next chunk, a few cache lines at a time: more at once would stall.
  NINEDOF_INLINE void reduce(const Block& b, const Columns& c, long next) {
    for (long k = 0; k < chunk; k += Lanes::lanes) {
      const long left = b.count - next - k;
      if (left > 0) Columns::prefetch_block(b, next + k, left < Lanes::lanes ? left : Lanes::lanes);
      Lanes m[6][6];
      conditioning_matrix(b.robot, c.poses<Lanes>(k), 1.0 / c.length<Lanes>(k), m);
      const Bidiagonal<Lanes> d = bidiagonalize(m);
#pragma GCC unroll 6
      for (int j = 0; j < 6; ++j) store(d.q[j], x[j] + k);
#pragma GCC unroll 5
      for (int j = 0; j < 5; ++j) store(d.e[j], x[6 + j] + k);
    }
  }
  template <class P>
  NINEDOF_INLINE Bidiagonal<P> load(long k) const {
    Bidiagonal<P> b;
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) b.q[j] = P::load(x[j] + k);
#pragma GCC unroll 5
    for (int j = 0; j < 5; ++j) b.e[j] = P::load(x[6 + j] + k);
    return b;
  }
};

/// The same with the characteristic lengths and the bidiagonal forms of M: work(columns, bidiagonals, first, rows).
template <class Work>
NINEDOF_INLINE void for_each_reduced_chunk(const Block& b, const Work& work) {
  Bidiagonals reduced;
  for_each_chunk(b, [&](Columns& c, long first, long rows) {
    c.gather_length(b, first, rows);
    reduced.reduce(b, c, first + rows);
    work(c, reduced, first, rows);
  });
}

/// Above this condition number, or if the distance of O from p is more than this many characteristic lengths times the
/// largest singular value of M, rounding errors are too large: the row is unsure.
constexpr double most_condition = 1e8, most_lever = 16.0;
/// So it is unless the larger of the platform's radius and this distance is between these multiples of the
/// characteristic length. Of angular columns that are so much longer or shorter than the others the smaller ones lose
/// digits that the Jacobi method for one configuration keeps: below, all that the ratio has; above, as few as it has at
/// 1e3, where the error is 1e-12. Millimetres with a length of 1 are there, and stay as quick as they were.
constexpr double least_size = 1.0 / 32.0, most_size = 1e3;

/// The largest distance of an external joint of the platform from p, squared.
NINEDOF_INLINE double squared_radius(const Joints& g) {
  double radius = 0.0;
  for (const auto& u : g.platform_external) {
    const double squared = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    if (squared > radius) radius = squared;
  }
  return radius;
}

template <class P>
NINEDOF_INLINE typename P::Mask lever_allows(const P& radius, const Columns& c, long k, const P& greatest) {
  const Poses<P> pose = c.poses<P>(k);
  const Xyz<P> y = pose.s - pose.p;
  const P lever = dot(y, y), unit = square(c.length<P>(k)), size = max(lever, radius);
  return (lever <= (most_lever * most_lever) * greatest * unit) & (size >= (least_size * least_size) * unit) &
         (size <= (most_size * most_size) * unit);
}

void leg_lengths(const Block& b, double* out) {
  for_each_chunk(b, [&](const Columns& c, long first, long rows) {
    alignas(64) double length[9][chunk];
    for (long k = 0; k < chunk; k += Lanes::lanes) {
      const Poses<Lanes> pose = c.poses<Lanes>(k);
      const LegVectors<Lanes> legs(b.robot, pose);
      SquaredLengths<Lanes> squared;
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) {
        const Xyz<Lanes> l = legs.external(i, legs.u(i)), q = legs.upper(i), r = legs.lower(i);
        store(sqrt(squared.of(l)), length[i] + k);
        store(sqrt(squared.of(q)), length[3 + i] + k);
        store(sqrt(squared.of(r)), length[6 + i] + k);
      }
      store(select(squared.clear(), Lanes::load(length[0] + k), unsure), length[0] + k);
    }
    scatter<9>(length, rows, out + 9 * first);
  });
}

void condition_numbers(const Block& b, double* out) {
  const Lanes radius(squared_radius(b.robot));
  for_each_reduced_chunk(b, [&](const Columns& c, const Bidiagonals& reduced, long first, long rows) {
    alignas(64) double kappa[chunk];
    for (long k = 0; k < chunk; k += Lanes::lanes) {
      const auto [least, greatest] = extreme_roots(reduced.load<Lanes>(k));
      const Lanes ratio = sqrt(greatest.x / least.x);
      const auto sure = (ratio <= most_condition) & lever_allows(radius, c, k, greatest.x);
      store(select(least.open | greatest.open, unsure, select(sure, ratio, unsure)), kappa + k);
    }
    scatter<1>(&kappa, rows, out + first);
  });
}

void frobenius_condition_numbers(const Block& b, double* out) {
  const Lanes radius(squared_radius(b.robot));
  for_each_reduced_chunk(b, [&](const Columns& c, const Bidiagonals& reduced, long first, long rows) {
    alignas(64) double kappa[chunk];
    for (long k = 0; k < chunk; k += Lanes::lanes) {
      const Polynomial<Lanes> p(reduced.load<Lanes>(k));
      const Lanes& sum = p.s[0];
      const Lanes ratio = sqrt(sum * (p.s[4] / p.s[5]));
      store(select((ratio <= most_condition) & lever_allows(radius, c, k, sum), ratio, unsure), kappa + k);
    }
    scatter<1>(&kappa, rows, out + first);
  });
}

void singular_values(const Block& b, double* out) {
  const Lanes radius(squared_radius(b.robot));
  for_each_reduced_chunk(b, [&](const Columns& c, const Bidiagonals& reduced, long first, long rows) {
    alignas(64) double sigma[6][chunk];
    for (long k = 0; k < chunk; k += Lanes::lanes) {
      const Roots<Lanes> root = all_roots(reduced.load<Lanes>(k));
      const auto sure =
          (root.x[5] <= (most_condition * most_condition) * root.x[0]) & lever_allows(radius, c, k, root.x[5]);
#pragma GCC unroll 6
      for (int j = 0; j < 6; ++j) {
        const Lanes value = 1.0 / sqrt(root.x[j]);
        store(j > 0 ? value : select(root.open, unsure, select(sure, value, unsure)), sigma[j] + k);
      }
    }
    scatter<6>(sigma, rows, out + 6 * first);
  });
}

void singularity_margins(const Block& b, double* out) {
  for_each_chunk(b, [&](const Columns& c, long first, long rows) {
    alignas(64) double margin[3][chunk];
    for (long k = 0; k < chunk; k += Lanes::lanes) {
      const Margins<Lanes> m = margins(b.robot, c.poses<Lanes>(k));
      store(select(m.sure, m.n, unsure), margin[0] + k);
      store(m.b, margin[1] + k);
      store(m.c, margin[2] + k);
    }
    scatter<3>(margin, rows, out + 3 * first);
  });
}

void hexagonal_condition_numbers(const double* designs, long count, double* out) {
  alignas(64) double column[6][chunk], kappa[chunk];
  for (long first = 0; first < count; first += chunk) {
    const long rows = count - first < chunk ? count - first : chunk;
    gather<6>(designs + 6 * first, 6, rows, column);
    for (long k = 0; k < chunk; k += Lanes::lanes) {
      const Lanes x[6] = {Lanes::load(column[0] + k), Lanes::load(column[1] + k), Lanes::load(column[2] + k),
                          Lanes::load(column[3] + k), Lanes::load(column[4] + k), Lanes::load(column[5] + k)};
      store(hexagonal_condition(x), kappa + k);
    }
    scatter<1>(&kappa, rows, out + first);
  }
}

void spectra(const double* const* points, long count, double length, double* out) {
  using Lane = PackOf<per_register>;  // the columns of two would not fit the registers
  constexpr int lanes = Lane::lanes;
  alignas(64) double at[42][lanes], numbers[spectrum_numbers][lanes];
  for (long first = 0; first < count; first += lanes) {
    const long rows = count - first < lanes ? count - first : lanes;
    for (long k = 0; k < lanes; ++k)  // the last is repeated
      for (int j = 0; j < 42; ++j) at[j][k] = points[first + (k < rows ? k : rows - 1)][j];
    spectrum(at, Lane(length), numbers);
    for (long k = 0; k < rows; ++k)
      for (int j = 0; j < spectrum_numbers; ++j) out[(first + k) * spectrum_numbers + j] = numbers[j][k];
  }
}

}  // namespace

#define NINEDOF_TEXT_(x) #x
#define NINEDOF_TEXT(x) NINEDOF_TEXT_(x)
extern const Table level_table;
const Table level_table = {NINEDOF_TEXT(NINEDOF_LEVEL),
                           Lanes::lanes,
                           leg_lengths,
                           condition_numbers,
                           frobenius_condition_numbers,
                           singular_values,
                           singularity_margins,
                           hexagonal_condition_numbers,
                           spectra};

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
