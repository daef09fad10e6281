#pragma once
/// SO(3): exponential, logarithm, quaternions (w, x, y, z), and the check of rotations given by a user.

#include <string>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// The matrix of the cross product: skew(v) * x = v x x.
Mat3 skew(const Vec3& v);

/// Rotation by |w| radians about w. Exact to rounding for every |w|, 0 included.
Mat3 exp_rotation(const Vec3& w);

/// How exp_rotation(w) turns as w changes: by turn_by_vector(w) dw about base axes (left Jacobian of SO(3)).
Mat3 turn_by_vector(const Vec3& w);

/// The rotation vector w with exp_rotation(w) = Q and |w| <= pi. Accurate to rounding near 0; the axis of a half turn
/// is one of the two possible ones.
Vec3 log_rotation(const Mat3& q);

/// Rotation about z by `angle` radians.
Mat3 rotation_about_z(double angle);

/// The rotation of a quaternion (w, x, y, z), normalized first. Throws InvalidArgument if it is zero or not finite.
Mat3 rotation_from_quaternion(const Eigen::Vector4d& wxyz);

/// The unit quaternion (w, x, y, z), w >= 0, of a rotation.
Eigen::Vector4d quaternion_from_rotation(const Mat3& q);

/// Throws InvalidArgument naming `argument` unless Q is finite, orthogonal to 1e-9 and of determinant +1.
void require_rotation(const std::string& argument, const Mat3& q);

}  // namespace ninedof
