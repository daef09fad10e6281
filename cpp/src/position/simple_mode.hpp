#pragma once
/// Whether a solution of the rotation problem is simple at the accuracy of its equations.

#include "position/polish_rotation.hpp"

namespace ninedof {

/// Whether the linear equations hold for a turn by error / separation along the direction that changes the equations
/// least. `separation` is the smallest singular value of J at the mode.
bool linear_along_weakest(const RotationProblem& problem, const PolishedRotation& mode, double separation,
                          double error);

/// Whether a change of the equations by `error` moves the solution in proportion, as a simple one: it neither meets
/// another solution nor slides along a family.
///
/// The separation alone does not tell. With nearly parallel directions the equations nearly agree, J is small, and so
/// is its change on the way to the next solution. The scale-free question is how far the linear equations hold.
inline bool is_simple(const RotationProblem& problem, const PolishedRotation& mode, double separation, double error) {
  // J changes by at most sqrt 3 per radian: by less than half of the separation within error / separation.
  return separation * separation >= 3.5 * error || linear_along_weakest(problem, mode, separation, error);
}

/// The direction of turning, a unit vector, that changes the equations least.
Vec3 weakest_direction(const RotationResidual& at);

}  // namespace ninedof
