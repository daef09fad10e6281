#pragma once
/// Logarithms of singular values and leg lengths over a box of designs, and their slopes.

#include <array>

#include "proof/optimum/axis_pieces.hpp"

namespace ninedof::proof {

using Box = std::array<Interval, coordinates>;

/// What a row is the logarithm of. The singular values are those of M, the leg lengths are in units of U.
enum Row : std::size_t { axial_max, axial_min, transverse_max, transverse_min, external_leg, upper_leg, lower_leg };
inline constexpr std::size_t rows = 7;

using Values = std::array<Interval, rows>;
using Slopes = std::array<Interval, coordinates>;

struct Pair {
  Interval max, min;
};
/// Of a block. The largest grows with g, f and w; the smallest grows with g and w and falls with f: the ranges are
/// those at corners.
Pair singular_values(const Block<Interval>& b);

Values axis_values(const AxisPieces<Interval>& p);

/// Along the logarithm of each coordinate: sums of fractions between 0 and 1, or little more. Along y and z only where `dimension` is that of all coordinates; with that of hexagons, y moves with x.
std::array<Slopes, rows> axis_slopes(const Box& box, const AxisPieces<Interval>& p, std::size_t dimension);

/// A number that no condition number in the box is below, from ranges alone; at least 1.
double natural_bound(const AxisPieces<Interval>& p);

}  // namespace ninedof::proof
