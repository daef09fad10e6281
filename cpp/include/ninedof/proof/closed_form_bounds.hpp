#pragma once
/// Certified condition numbers of C3 designs on their axis, by the closed form over intervals.
///
/// Assumptions and errors as in bounds.hpp. The first joint of each orbit is taken as exact, the others as its exact
/// images.

#include "ninedof/math/interval.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// The condition number of J', by `axis_spectrum` over intervals. The relative width is about 3e-14 unless coordinates
/// cancel. Throws InvalidArgument naming what violates the symmetry, as `axis_design`.
Interval axis_condition_number_bounds(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// Hexagonal designs at their neutral configuration, eqs. (6), (37) and (38), from their six numbers without rounding:
/// rows a1 a2 b1 b2 zp zs in units of the characteristic length; lower and upper bound into rows of `out`. The relative
/// width is about 1e-14, also near singular designs. NaN for a row that has NaN.
void hexagonal_condition_number_bounds(const double* designs, long count, double* out);

}  // namespace ninedof
