#pragma once
/// The length that makes the Jacobian homogeneous, computed from the robot.

#include <string>

#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Ways to choose the characteristic length.
enum class LengthKind {
  mean_leg,         ///< mean of the nine leg lengths
  platform_radius,  ///< largest distance of a platform joint from the platform origin
  natural,          ///< makes the angular and translational columns of M equal in Frobenius norm
  optimal,          ///< minimizes the condition number
};

/// "mean_leg", "platform_radius", "natural" or "optimal"; throws InvalidArgument for any other word.
LengthKind length_kind(const std::string& word);

/// The characteristic length of a configuration, in its length unit. `natural` and `optimal` are NaN at a singular
/// configuration: the condition number is infinite with any length there.
double characteristic_length(const Geometry& g, const Configuration& c, LengthKind kind = LengthKind::optimal);

}  // namespace ninedof
