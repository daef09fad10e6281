#pragma once
/// Logarithms of singular values and leg lengths over a box of designs, and their slopes.

#include <array>

#include "proof/optimum/axis_pieces.hpp"

namespace ninedof::proof {

using Box = std::array<Interval, coordinates>;

/// What a row is the logarithm of. The singular values are those of M, the leg lengths are in units of U, the sizes
/// after them in l_c.
enum Row : std::size_t {
  axial_max,
  axial_min,
  transverse_max,
  transverse_min,
  external_leg,
  upper_leg,
  lower_leg,
  base_size,       ///< R
  height_size,     ///< zp
  internal_size,   ///< zs
  lower_size,      ///< distance of the internal base joints from the axis; of hexagons no row of its own
  upper_size,      ///< the same of the internal platform joints
};
inline constexpr std::size_t rows = 12, first_size = base_size, sizes = rows - first_size;

/// Of R, zp, zs and the distances of internal joints: a number for each size.
using Sizes = std::array<Interval, sizes>;

using Values = std::array<Interval, rows>;
using Slopes = std::array<Interval, coordinates>;

struct Pair {
  Interval max, min;
};
/// Of a block. The largest grows with g, f and w; the smallest grows with g and w and falls with f: the ranges are
/// those at corners.
Pair singular_values(const Block<Interval>& b);

/// Of all rows but the sizes.
Values axis_values(const AxisPieces<Interval>& p);

/// How many of the sizes are numbers of their own.
inline std::size_t sizes_of(const Chart& chart) {
  return chart.hexagonal() ? sizes - 2 : sizes;
}
/// zs / zp.
Interval axis_share(const Box& box, const Chart& chart);
/// In units of U.
Sizes axis_sizes(const Box& box, const Chart& chart);
/// Of the logarithm of a size in l_c, where U / l_c is a coordinate.
Slopes axis_size_slopes(const Box& box, const Chart& chart, std::size_t row);

/// Along the logarithm of each coordinate: sums of fractions between 0 and 1, or little more. Of hexagons y moves with
/// x; where l_c is of a kind, U / l_c with all others. Of all rows but the sizes.
std::array<Slopes, rows> axis_slopes(const Box& box, const AxisPieces<Interval>& p, const Chart& chart);

/// Where l_c is of a kind, U / l_c from the other coordinates.
Interval size_of(const Box& box, const Chart& chart);

/// The box with what follows from the coordinates that are cut. U / l_c is inverted where the box holds no design.
void settle(Box& box, const Chart& chart);

/// A number that no condition number in the box is below, from ranges alone; at least 1.
double natural_bound(const AxisPieces<Interval>& p);

}  // namespace ninedof::proof
