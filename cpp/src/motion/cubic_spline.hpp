#pragma once
/// Cubic splines through points.

#include <span>
#include <vector>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// The cubic spline through the points y at the increasing knots x, at other places. Periodic, where the first point is
/// the last, or with a continuous third derivative at the first and last inner knot ("not a knot"). At least four
/// knots.
std::vector<Vec3> cubic_spline(std::span<const double> x, std::span<const Vec3> y, std::span<const double> at,
                               bool periodic);

}  // namespace ninedof
