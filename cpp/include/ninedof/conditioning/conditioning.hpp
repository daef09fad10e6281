#pragma once
/// Kinetostatic indices of the homogenized Jacobian J' (eqs. 2-5).
///
/// J' is never formed. Let the rows of [N_q N_r] be an orthonormal basis of the left null space of [C; B]. The
/// conditioning matrix M = [A; N_q E], 6x6, satisfies M J' = [1 0 0; 0 -N_q -N_r], whose rows are orthonormal: the
/// singular values of M are the reciprocals of those of J'. No matrix is inverted or squared, and a singular
/// configuration has sigma_min(M) = 0 (docs/theory/conditioning.md).
///
/// A singular value of M below 16 eps = 3.6e-15 of the largest counts as zero: condition numbers above 2.8e14 are
/// infinite.

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// All functions here take lengths in one unit, throw InvalidArgument unless the characteristic length is finite and
/// positive, and return NaN for a configuration that contains NaN.

/// The conditioning matrix M, 6x6, columns (l_c omega, pdot).
Mat6 conditioning_matrix(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// The matrix norm of the condition number.
enum class Norm {
  two,        ///< sigma_max / sigma_min, eq. (2); 1 at best
  frobenius,  ///< |J'|_F |J'^+|_F, eq. (4) with the pseudo-inverse; 6 at best, differentiable everywhere
};

/// Singular values of J', descending; some are infinite at a singular configuration.
Vec6 singular_values(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// Condition number of J'; infinite at a singularity.
double condition_number(const Geometry& g, const Configuration& c, double characteristic_length = 1.0,
                        Norm norm = Norm::two);

/// 1 / condition number: bounded, 1 at isotropy and 0 at a singularity.
double reciprocal_condition_number(const Geometry& g, const Configuration& c, double characteristic_length = 1.0,
                                   Norm norm = Norm::two);

/// sqrt(det(J' J'^T)), the product of the singular values; infinite at a singularity (some twist is possible with all
/// legs locked).
double manipulability(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);
double manipulability(const Vec6& singular_values);

/// |J' J'^T - sigma 1|_F / |sigma 1|_F with sigma = trace(J' J'^T) / 6: eq. (5) with the 6x6 product, which has full
/// rank. 0 exactly at isotropy; infinite at a singularity.
double isotropy_residual(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);
double isotropy_residual(const Vec6& singular_values);  ///< descending

}  // namespace ninedof
