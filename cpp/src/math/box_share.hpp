#pragma once
/// The part of a box on one side of a plane: its share of the volume, and points whose hull holds it.
///
/// Coordinates t go from -1 to 1 over each side of the box, so that linear forms (form.hpp) give the planes.

#include <array>
#include <vector>

#include "ninedof/math/interval.hpp"

namespace ninedof::forms {

template <std::size_t N>
using Slope = std::array<double, N>;
using Slope3 = Slope<3>;

/// At least the greatest slope . t of the box, which has 3 or 4 coordinates.
template <std::size_t N>
double reach(const Slope<N>& slope);

/// The share of the box where slope . t < level.
Interval share_below(const Slope3& slope, double level);

/// Points of the box whose hull holds all t of it with slope . t >= level: corners, and points of edges. They may lie
/// below the level by rounding. None where no t of the box is above it.
template <std::size_t N>
std::vector<Slope<N>> hull_above(const Slope<N>& slope, double level);

}  // namespace ninedof::forms
