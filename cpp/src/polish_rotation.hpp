#pragma once
/// The last digits of a rotation, by Newton's method on SO(3).

#include "rotation_problem.hpp"

namespace ninedof {

/// How the equations stand at a rotation: residuals d_i . Q w_i - c_i and their derivative J by a small rotation from the left, rows
/// (Q w_i) x d_i.
struct RotationResidual {
  RotationResidual(const RotationProblem& problem, const Mat3& rotation);

  Vec3 value;
  Triple row;
  Triple adjugate;  ///< columns of det(J) J^-1
  double determinant;

  double largest() const { return value.cwiseAbs().maxCoeff(); }
  /// Newton's step -J^-1 f, a rotation vector. Not finite where J is singular.
  Vec3 newton_step() const {
    return (-1.0 / determinant) * (value[0] * adjugate[0] + value[1] * adjugate[1] + value[2] * adjugate[2]);
  }
  /// Largest singular value of J^-1: one over the distance of J from the singular matrices. Infinite at one.
  double inverse_norm() const;
};

struct PolishedRotation {
  Mat3 rotation;
  RotationResidual at;
};

/// Newton's step, no longer than half a radian, and Levenberg's where that does not lower the residual. The result is orthogonal to
/// rounding. At a double solution convergence is linear, and half the digits of the rotation are all there is.
///
/// `at_start` is the residual there.
PolishedRotation polish_rotation(const RotationProblem& problem, const Mat3& start, const RotationResidual& at_start,
                                 int most_steps = 60);

}  // namespace ninedof
