#pragma once
/// Exact derivatives of the singular values of M with respect to every point of the robot, in any configuration
/// (docs/theory/conditioning.md).
///
/// For a twist t, |M t|^2 is the least sum of squares of the nine leg rates over the velocity sdot of O:
///     |M t|^2 = min over sdot of  sum (leg rates of t and sdot)^2,
/// because N_q E t is the part of E t that no sdot can compensate. |M t|^2 is stationary in the twist of a singular
/// vector and in its sdot, so both are held fixed and d(sigma^2) = 2 sum (leg rate) d(leg rate): no derivative of a
/// singular vector or of an inverse is needed. Two twists of one cluster of singular values give the mixed derivative
/// in the same way.
///
/// Shares only the singular value routine with conditioning.cpp: the tests check each against the other.

#include <span>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

/// Singular values of M (reciprocals of those of J'), descending, with the data for their derivatives.
struct Spectrum {
  Vec6 sigma;
  Mat6 twist;                          ///< right singular vectors, (l_c omega, pdot), one per column
  Eigen::Matrix<double, 3, 6> sdot;    ///< velocity of O for each twist
  Mat96 rates;                         ///< leg rates for each twist
  double characteristic_length;
  int locked = -1;  ///< the leg of locked_spectrum, whose rates are 0: `rates` has the forces in it
};

/// Throws InvalidArgument unless the characteristic length is finite and positive.
Spectrum spectrum(const Points& at, const NineLegs& legs, double characteristic_length);

/// Derivatives with respect to the points and the characteristic length.
struct PointGradient {
  Points point;
  double length;
};

PointGradient zero_gradient();

/// Adds `scale` times d(v_a^T M^T M v_b) to `out`, both vectors held fixed. For a = b this is the gradient of
/// sigma_a^2.
void add_spectrum_gradient(const Points& at, const NineLegs& legs, const Spectrum& s, int a, int b, double scale,
                           PointGradient& out);

}  // namespace ninedof
