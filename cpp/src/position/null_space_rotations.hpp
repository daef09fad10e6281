#pragma once
/// All rotations of a RotationProblem by linear algebra, without start values or a chart of the rotations.

#include "position/rotation_problem.hpp"

namespace ninedof {

/// For a unit quaternion z each equation is a quadric, z^T K_i z = 0, and three quadrics in projective space meet in
/// eight points. These are the eigenvectors of an 8x8 matrix, found in the null space of all products of the quadrics
/// with quadratic monomials (Macaulay's matrix). Half turns, symmetric robots and coinciding joints are no special
/// cases.
///
/// Candidates have an error of 1e-10 in general position, about 1e-8 at a double root and 1e-4 where eight roots merge;
/// polish_rotation removes it. Expects |c_i| <= 1 up to rounding: otherwise no rotation is real. Does not allocate.
RotationCandidates null_space_rotations(const RotationProblem& problem);

}  // namespace ninedof
