#pragma once
/// Certified numbers of a robot at a pose: rigorous lower and upper bounds.
///
/// The doubles of geometry, configuration and characteristic length are taken as exact numbers, the rotation matrix as
/// it stands: the platform joints are at p + Q u_i whether or not Q is orthogonal to the last bit. A statement about
/// these points holds for a true robot whose platform differs from the one given by the rounding of Q.
///
/// Assumed: what interval.hpp assumes of the arithmetic. Nothing is assumed of the approximate
/// singular vectors and inverses that are used: they are verified (docs/theory/proof.md#certified-numbers).
///
/// Every function throws std::runtime_error where `arithmetic_fault` finds the arithmetic of this thread unfit, and
/// InvalidArgument unless the characteristic length is finite and positive. A configuration with NaN, and numbers
/// beyond the range of doubles, give bounds that say nothing.

#include <array>

#include "ninedof/math/interval.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// l1 l2 l3 q1 q2 q3 r1 r2 r3, the order of eq. (35b).
std::array<Interval, 9> leg_length_bounds(const Geometry& g, const Configuration& c);

/// The singular values of J', descending; the upper bound is infinite where a singularity cannot be excluded.
std::array<Interval, 6> singular_value_bounds(const Geometry& g, const Configuration& c,
                                              double characteristic_length = 1.0);

/// The condition number of J'. The relative width is about 1.5e-14 times the condition number; the upper bound is
/// infinite where a singularity cannot be excluded.
Interval condition_number_bounds(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// J' of eq. (36) element by element; all numbers where a singularity cannot be excluded.
std::array<std::array<Interval, 9>, 6> jacobian_bounds(const Geometry& g, const Configuration& c,
                                                       double characteristic_length = 1.0);

/// The three determinants of `singularity_margins`, within [-1, 1].
struct DeterminantBounds {
  Interval n, b, c;
};
DeterminantBounds determinant_bounds(const Geometry& g, const Configuration& c);

}  // namespace ninedof
