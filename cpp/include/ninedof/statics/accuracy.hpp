#pragma once
/// How far legs and joints that are not quite as drawn move the platform and O.
///
/// To first order a joint that is off by d acts as a change of its leg's length by the component of d along the leg, so
/// every error is one of nine effective lengths and the motion is H^-1 times them (H of eqs. (24)-(26), 9x9). The nine
/// meet no error of O: that six legs end in one point is what makes O a point.

#include <array>
#include <cstdint>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// What is known of the errors, lengths >= 0.
struct Tolerances {
  Vec9 legs = Vec9::Zero();         ///< leg k is off by at most legs[k], either way
  std::array<double, 12> joints{};  ///< a joint lies in a ball of this radius: r 1-3, r^ 1-3, u 1-3, u~ 1-3
};

/// Throws InvalidArgument for a tolerance that is negative or infinite; NaN passes, and makes the answer NaN.
void validate(const Tolerances& t);

/// H^-1: (rotation, displacement of p, displacement of O), base axes, for each unit of length error.
///
/// At a singular configuration first order knows no answer: rows of what the lengths do not determine are infinite, all
/// nine where det B = 0, the first six where det C or det M = 0. NaN where the configuration has NaN.
Mat9 error_map(const Geometry& g, const Configuration& c);

/// First-order bounds and covariance.
struct ErrorBounds {
  Vec9 components;        ///< largest |rotation_x|, ... |s_z|, each for the errors that are worst for it
  double rotation;        ///< largest angle, rad
  double position;        ///< largest displacement of p
  double internal_point;  ///< largest displacement of O
  /// Of (rotation, p, s) with independent errors, uniform within their tolerances. Where a row of the map is infinite,
  /// infinite on the diagonal and NaN beside it.
  Mat9 covariance;
};

/// Every bound is attained: a linear map of a box is largest at a corner, and all corners are tried.
ErrorBounds error_bounds(const Geometry& g, const Configuration& c, const Tolerances& t);

/// One robot made and set with random errors, uniform within their tolerances: the tangent (rotation, p, s) from the
/// intended configuration to the one it takes, without linearization. NaN where no configuration can be followed there
/// from the intended one. Errors are those of (seed, index), whatever was drawn before.
Vec9 error_sample(const Geometry& g, const Configuration& c, const Tolerances& t, std::uint64_t seed,
                  std::uint64_t index);

}  // namespace ninedof
