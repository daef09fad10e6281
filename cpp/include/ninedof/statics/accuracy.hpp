#pragma once
/// The effect of errors of legs and joints on the position of the platform and of O (docs/theory/statics.md).
///
/// To first order a joint error d changes the length of its leg by the component of d along the leg. So all errors
/// reduce to errors of nine effective lengths, and the motion is H^-1 times these (H of eqs. (24)-(26), 9x9). The joint
/// at O has no error: six legs meet in it exactly.

#include <array>
#include <cstdint>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Bounds of the errors, lengths >= 0.
struct Tolerances {
  Vec9 legs = Vec9::Zero();         ///< largest error of each leg, in both directions
  std::array<double, 12> joints{};  ///< radius of the ball in which a joint lies: r 1-3, r^ 1-3, u 1-3, u~ 1-3
};

/// Throws InvalidArgument for a tolerance that is negative or infinite. NaN is allowed and makes the result NaN.
void validate(const Tolerances& t);

/// H^-1: (rotation, displacement of p, displacement of O), base axes, for each unit of length error.
///
/// At a singular configuration the rows that the lengths do not determine are infinite: all nine where det B = 0, the
/// first six where det C = 0 or det N = 0. NaN if the configuration has NaN.
Mat9 error_map(const Geometry& g, const Configuration& c);

/// First-order bounds and covariance.
struct ErrorBounds {
  Vec9 components;        ///< largest |rotation_x|, ... |s_z|, each for its worst case of errors
  double rotation;        ///< largest angle, rad
  double position;        ///< largest displacement of p
  double internal_point;  ///< largest displacement of O
  /// Covariance of (rotation, p, s) for independent errors, uniform within their tolerances. Where a row of the map is
  /// infinite: infinite on the diagonal and NaN elsewhere in the row.
  Mat9 covariance;
};

/// Every bound is attained: a linear map of a box has its largest value at a corner, and all corners are evaluated.
ErrorBounds error_bounds(const Geometry& g, const Configuration& c, const Tolerances& t);

/// A robot with random errors, uniform within their tolerances: the tangent (rotation, p, s) from the intended
/// configuration to the one it reaches with the intended leg lengths, without linearization. NaN if no configuration
/// can be tracked from the intended one. The errors depend on (seed, index) only.
Vec9 error_sample(const Geometry& g, const Configuration& c, const Tolerances& t, std::uint64_t seed,
                  std::uint64_t index);

}  // namespace ninedof
