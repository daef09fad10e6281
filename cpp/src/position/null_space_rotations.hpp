#pragma once
/// All rotations of a RotationProblem at once, by linear algebra: no start values, no chart of the rotations.

#include "position/rotation_problem.hpp"

namespace ninedof {

/// For a unit quaternion z each equation is a quadric, z^T K_i z = 0, and three quadrics in projective space meet in eight
/// points. These are the eigenvectors of an 8x8 matrix, found in the null space of all products of the quadrics with
/// quadratic monomials (Macaulay's matrix). Half turns are ordinary points; so are symmetric robots and coinciding joints.
///
/// Candidates are good to 1e-10 in general position, to some 1e-8 at a double root and to 1e-4 where eight merge;
/// polish_rotation does the rest. Expects |c_i| <= 1 up to rounding: beyond that no rotation is real. Does not allocate.
RotationCandidates null_space_rotations(const RotationProblem& problem);

}  // namespace ninedof
