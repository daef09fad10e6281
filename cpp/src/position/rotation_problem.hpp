#pragma once
/// The rest of the direct position problem once O is known in both frames: a rotation.

#include <array>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Rotations Q with d_i . Q w_i = c_i for three pairs of unit vectors: d in base axes, w in platform axes.
struct RotationProblem {
  Triple d, w;
  Vec3 c;
};

/// Approximations of the real solutions, at most eight; polish_rotation refines them.
struct RotationCandidates {
  std::array<Mat3, 8> rotation;
  int count = 0;
  bool self_motion = false;  ///< the solutions form a family, and none is listed
  bool reliable = true;      ///< false if a solution may be missing
};

}  // namespace ninedof
