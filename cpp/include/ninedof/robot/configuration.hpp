#pragma once
/// The configuration of the robot: nine coordinates.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Position p of the platform frame, rotation Q (platform to base) and internal point s, all in the base frame.
struct Configuration {
  Vec3 position = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();
  Vec3 internal_point = Vec3::Zero();
};

/// Eq. (6): p = (0, 0, zp), s = (0, 0, zs), Q a rotation by theta_z radians about z (the paper has theta_z = 0).
Configuration neutral(double zp, double zs, double theta_z = 0.0);

/// The configuration displaced by a tangent (omega, dp, ds) in the base frame: Q becomes exp(omega) Q.
Configuration plus(const Configuration& c, const Vec9& tangent);

/// The tangent from `from` to `to`: plus(from, minus(to, from)) = to, with the shorter of the two rotations.
Vec9 minus(const Configuration& to, const Configuration& from);

/// Throws InvalidArgument if a value is not finite or the rotation is not proper.
void validate(const Configuration& c);

}  // namespace ninedof
