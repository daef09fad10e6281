#pragma once
/// What a unit ball of leg rates makes of the platform's velocity, and a unit ball of leg forces carries: Fig. 4.
///
/// The image under J' of all leg rates with |udot| <= 1 is the set of twists that need no more than that: |X t| <= 1,
/// where |X t| is the least norm of the leg rates over all motions of O. Its axes are the right singular vectors of X,
/// its semi-axes 1 / sigma(X) = sigma(J'). Forces are dual: the wrenches w = (moment / l_c, force) with |J'^T w| <= 1,
/// that is, balanced by leg forces of norm 1 at most with no force on O, have the same axes and the reciprocal
/// semi-axes. X exists where J' does not: at a singular configuration a velocity is unlimited and a force zero.

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Centred at 0. Columns of `directions` are orthonormal, the entry of largest modulus positive; semi-axes descend.
template <int N>
struct Ellipsoid {
  Eigen::Matrix<double, N, N> directions;
  Eigen::Matrix<double, N, 1> semi_axes;
};

/// The three numbers of a twist (l_c omega, pdot), or of a wrench (moment / l_c, force), that are looked at.
enum class TwistPart { rotation, translation };

/// Of the whole twist (l_c omega, pdot). Semi-axes are the singular values of J'; infinite, with the directions of the
/// free motions, where the configuration is singular. NaN where it has NaN.
Ellipsoid<6> velocity_ellipsoid(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// Of l_c omega or of pdot alone, whatever the other does: the shadow of the six-dimensional one. Finite where a free
/// motion leaves this part at rest; then it may be smaller than at configurations nearby, since at a singular one the
/// nine leg rates are no longer free.
Ellipsoid<3> velocity_ellipsoid(const Geometry& g, const Configuration& c, TwistPart part,
                                double characteristic_length = 1.0);

/// Wrenches that leg forces of norm 1 balance.
Ellipsoid<6> force_ellipsoid(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// Pure moments (over l_c), or pure forces through p: the section of the six-dimensional one.
Ellipsoid<3> force_ellipsoid(const Geometry& g, const Configuration& c, TwistPart part,
                             double characteristic_length = 1.0);

}  // namespace ninedof
