#pragma once
/// Exact derivatives of the singular values of M with respect to every point of the robot, at any pose.
///
/// For a twist t, |M t|^2 is the least sum of squares of the nine leg rates over the velocity sdot of O:
///     |M t|^2 = min over sdot of  sum (leg rates of t and sdot)^2,
/// because the part of E t that B and C leave over is what no sdot can take away. With the twist of a singular vector and its
/// sdot held fixed (both are stationary), d(sigma^2) is therefore 2 sum (leg rate) d(leg rate): no derivative of a
/// singular vector and none of an inverse is needed. Two twists of one cluster give the mixed derivative in the same way.
///
/// Shares no code with conditioning.cpp beyond the singular value routine: each is the other's oracle.

#include <span>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

/// Singular values of M (reciprocals of those of J'), descending, with what their derivatives need.
struct Spectrum {
  Vec6 sigma;
  Mat6 twist;                          ///< right singular vectors, (l_c omega, pdot), one a column
  Eigen::Matrix<double, 3, 6> sdot;    ///< velocity of O that goes with each
  Eigen::Matrix<double, 9, 6> rates;   ///< leg rates that go with each
  double characteristic_length;
};

/// Throws InvalidArgument unless the characteristic length is finite and positive.
Spectrum spectrum(const Points& at, const NineLegs& legs, double characteristic_length);

/// Derivatives with respect to the points and the characteristic length.
struct PointGradient {
  Points point;
  double length;
};

PointGradient zero_gradient();

/// Adds `scale` times d(v_a^T M^T M v_b) to `out`, both vectors held fixed: for a = b that of sigma_a^2.
void add_spectrum_gradient(const Points& at, const NineLegs& legs, const Spectrum& s, int a, int b, double scale,
                           PointGradient& out);

}  // namespace ninedof
