#pragma once
/// A rotation near a solution of a RotationProblem, made one.

#include "rotation_problem.hpp"

namespace ninedof {

struct PolishedRotation {
  Mat3 rotation;    ///< orthogonal to rounding, converged or not
  Mat3 jacobian;    ///< rows (Q w_i) x d_i: the derivatives of d_i . Q w_i by a small rotation of Q, base axes
  double residual;  ///< max |d_i . Q w_i - c_i|
  bool converged;   ///< residual at most 1e-13
};

/// Newton's method on SO(3), Levenberg's where Newton's step does not lower the residual; no step above half a radian.
///
/// Four steps are usual. At a double root a step halves the error, until the residual is at rounding and the rotation
/// within some 1e-8 of the root (a flat root: 1e-6); more is not in the data. Hence so many steps. Does not allocate.
PolishedRotation polish_rotation(const RotationProblem& problem, const Mat3& start, int most_steps = 60);

}  // namespace ninedof
