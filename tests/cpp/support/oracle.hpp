#pragma once
/// A second way from a robot to its Jacobian, sharing nothing with src/legs.cpp, velocity.cpp, conditioning.cpp and
/// svd6.cpp but the stored joints: leg lengths as distances, differentiated by a complex step in extended precision,
/// the 9x9 matrix of rates inverted by pivoted elimination, singular values by Eigen's two-sided Jacobi method.
///
/// With 64 bits of mantissa it has about 1e-19 times the conditioning of error. Where long double is double it is as
/// good as the code under test and no better, and tests built on it ask too much.

#include <Eigen/Core>

#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace oracle {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// Lengths l, q, r of the nine legs.
Vector leg_lengths(const ninedof::Geometry& g, const ninedof::Configuration& c);

/// d(l, q, r) / d(omega, p, s), 9x9, rotations applied from the left: Q becomes exp(omega) Q.
Matrix rates(const ninedof::Geometry& g, const ninedof::Configuration& c);

/// J', 6x9: the first six rows of the inverse of `rates`, the angular ones times the characteristic length.
Matrix jacobian(const ninedof::Geometry& g, const ninedof::Configuration& c, double characteristic_length);

/// Descending.
Vector singular_values(const Matrix& m);

/// Largest over smallest singular value of J'.
Real condition_number(const ninedof::Geometry& g, const ninedof::Configuration& c, double characteristic_length);

}  // namespace oracle
