#pragma once
/// The nine legs of a robot as vectors of intervals. The numbers of geometry and configuration are taken as exact.

#include <array>

#include "ninedof/math/interval.hpp"
#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// A vector by its length and unit vector; each component of the latter is [-1, 1] where the length may be zero.
struct DirectionBounds {
  Interval length;
  Xyz<Interval> unit;
};
DirectionBounds direction_bounds(const Xyz<Interval>& vector);

/// `x` times 2^power.
Interval times_power_of_two(const Interval& x, int power);

/// The legs in the order of eq. (35b), the platform joints Q u_i and Q u~_i, and what the singularities need.
struct LegBounds {
  std::array<DirectionBounds, 9> legs;
  std::array<Xyz<Interval>, 3> u, u_tilde;
  std::array<Xyz<Interval>, 3> d, w;  ///< from O to the base joint and to the platform joint of external leg i
  Xyz<Interval> y;                    ///< s - p
};
LegBounds leg_bounds(const Geometry& g, const Configuration& c);

}  // namespace ninedof
