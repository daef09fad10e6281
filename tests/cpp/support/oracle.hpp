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

/// Largest over smallest singular value of J'.
Real condition_number(const ninedof::Geometry& g, const ninedof::Configuration& c, double characteristic_length);

/// Largest over smallest singular value of `rates`: how much of an answer rounding may take.
double conditioning_of_rates(const ninedof::Geometry& g, const ninedof::Configuration& c);

/// Eigen's linear algebra for the tests, compiled here once: in every test file it would take half of the time to build
/// them. All by pivoted elimination or two-sided Jacobi rotations.
Matrix wide(const Eigen::Ref<const Eigen::MatrixXd>& m);
Eigen::MatrixXd rounded(const Matrix& m);
Matrix product(const Matrix& a, const Matrix& b);
/// m diag(weights) m^T.
Matrix congruence(const Matrix& m, const Vector& weights);
/// |m^T m - 1|: zero if the columns are orthonormal.
double from_orthonormal(const Matrix& m);
Matrix inverse(const Matrix& m);
Matrix solve(const Matrix& a, const Matrix& b);
Real determinant(const Matrix& m);

/// How many singular values are larger than the rounding errors of doubles.
Eigen::Index rank(const Matrix& m);

/// Descending.
Vector singular_values(const Matrix& m);
double least_singular_value(const Eigen::Ref<const Eigen::MatrixXd>& m);

/// Largest over smallest singular value.
double conditioning_of(const Matrix& m);

/// All of them, those of singular value zero too, in the order of the singular values.
Matrix right_singular_vectors(const Matrix& m);
Matrix left_singular_vectors(const Matrix& m);

/// The shortest x with the least |a x - b|; singular values below `threshold` times the largest count as zero.
Vector least_squares(const Matrix& a, const Vector& b, Real threshold);

/// Ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& m);

}  // namespace oracle
