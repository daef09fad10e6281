#pragma once
/// What is left of the direct position problem once O is known from both plates: a rotation.

#include <array>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Rotations Q with d_i . Q w_i = c_i for three pairs of unit vectors: d in base axes, w in platform axes.
struct RotationProblem {
  Triple d, w;
  Vec3 c;
};

/// Rotations near the real solutions, unpolished; at most eight.
struct RotationCandidates {
  std::array<Mat3, 8> rotation;
  int count = 0;
  bool self_motion = false;  ///< the equations leave a family of rotations: there is no list
  bool reliable = true;      ///< false: the method saw its own limits, a solution may be missing
};

}  // namespace ninedof
