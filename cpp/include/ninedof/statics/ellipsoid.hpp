#pragma once
/// Velocities of the platform for leg rates of norm 1, and loads for leg forces of norm 1: Fig. 4
/// (docs/theory/statics.md).
///
/// The image under J' of all leg rates with |udot| <= 1 is the set of twists t with |X t| <= 1, where |X t| is the
/// least norm of the leg rates over all motions of O. Its axes are the right singular vectors of X, its semi-axes 1 /
/// sigma(X) = sigma(J'). Forces are dual: the wrenches w = (moment / l_c, force) with |J'^T w| <= 1, which leg forces
/// of norm 1 balance without a force on O, have the same axes and the reciprocal semi-axes. X exists where J' does not:
/// at a singular configuration some velocity is unlimited and some force zero.

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Centred at 0. Columns of `directions` are orthonormal with a positive entry of largest modulus; semi-axes descend.
template <int N>
struct Ellipsoid {
  Eigen::Matrix<double, N, N> directions;
  Eigen::Matrix<double, N, 1> semi_axes;
};

/// One half of a twist (l_c omega, pdot) or of a wrench (moment / l_c, force).
enum class TwistPart { rotation, translation };

/// For the whole twist (l_c omega, pdot). Semi-axes are the singular values of J'. At a singular configuration those of
/// the free motions are infinite. NaN if the configuration has NaN.
Ellipsoid<6> velocity_ellipsoid(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// For l_c omega or pdot alone, with any value of the other: the projection of the six-dimensional ellipsoid. Finite if
/// no free motion contains this part; it may then be smaller than at configurations nearby, because at a singular
/// configuration the nine leg rates are not independent.
Ellipsoid<3> velocity_ellipsoid(const Geometry& g, const Configuration& c, TwistPart part,
                                double characteristic_length = 1.0);

/// Wrenches that leg forces of norm 1 balance.
Ellipsoid<6> force_ellipsoid(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// Pure moments (over l_c), or pure forces through p: the section of the six-dimensional ellipsoid.
Ellipsoid<3> force_ellipsoid(const Geometry& g, const Configuration& c, TwistPart part,
                             double characteristic_length = 1.0);

}  // namespace ninedof
