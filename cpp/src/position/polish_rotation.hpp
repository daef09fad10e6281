#pragma once
/// Polishes a rotation to full accuracy by Newton's method on SO(3) (docs/theory/position.md).

#include "position/rotation_problem.hpp"

namespace ninedof {

/// The residuals d_i . Q w_i - c_i and their derivative J by a small rotation from the left, rows (Q w_i) x d_i.
struct RotationResidual {
  RotationResidual(const RotationProblem& problem, const Mat3& rotation);

  Vec3 value;
  Triple row;
  Triple adjugate;  ///< columns of det(J) J^-1
  double determinant;

  double largest() const { return value.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(); }
  /// -J^-1 f, a rotation vector. Not finite where J is singular.
  Vec3 newton_step(const Vec3& f) const {
    return (-1.0 / determinant) * (f[0] * adjugate[0] + f[1] * adjugate[1] + f[2] * adjugate[2]);
  }
  Vec3 newton_step() const { return newton_step(value); }
  /// Largest singular value of J^-1: the reciprocal of the distance of J from the nearest singular matrix.
  double inverse_norm() const;
};

/// A rotation, orthogonal to rounding, and the equations there.
struct PolishedRotation {
  Mat3 rotation;
  RotationResidual at;
  double residual() const { return at.largest(); }
  bool converged() const { return residual() <= 1e-13; }
};

/// Newton's method on SO(3), with Levenberg steps where Newton's does not improve; steps up to half a radian.
///
/// Usually four steps. At a double solution each step halves the error, until the residual is rounding and the rotation
/// within about 1e-8 of the solution (1e-6 at a flat one), the accuracy that the data allow; hence the large limit on
/// the steps. `at_start` is the residual at `start`.
PolishedRotation polish_rotation(const RotationProblem& problem, const Mat3& start, const RotationResidual& at_start,
                                 int most_steps = 60);
inline PolishedRotation polish_rotation(const RotationProblem& problem, const Mat3& start, int most_steps = 60) {
  return polish_rotation(problem, start, RotationResidual(problem, start), most_steps);
}

}  // namespace ninedof
