#pragma once
/// The length that makes the Jacobian homogeneous, chosen from the robot itself.

#include <string>

#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Ways to choose the characteristic length.
enum class LengthKind {
  mean_leg,         ///< mean of the nine leg lengths
  platform_radius,  ///< largest distance of a platform joint from the platform origin
  natural,  ///< makes the rotation and translation columns of M equal in Frobenius norm; isotropic designs keep it
  optimal,  ///< makes the condition number least
};

/// "mean_leg", "platform_radius", "natural" or "optimal"; throws InvalidArgument for another word.
LengthKind length_kind(const std::string& word);

/// The characteristic length of a configuration, in its length unit. `natural` and `optimal` are NaN at a singular
/// configuration, where no length helps.
double characteristic_length(const Geometry& g, const Configuration& c, LengthKind kind = LengthKind::optimal);

}  // namespace ninedof
