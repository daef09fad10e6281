#pragma once
/// What is left of the direct position problem once O is known in both frames: how the platform is turned about it.

#include "ninedof/types.hpp"

namespace ninedof {

/// Rotations Q with d_i . Q w_i = c_i for three pairs of unit vectors: d in base axes, w in platform axes.
struct RotationProblem {
  Triple d, w;
  Vec3 c;
};

/// Rotations near the real solutions, unpolished; at most eight. Some may be near none, or two near the same: what
/// polishing makes of them decides.
struct RotationCandidates {
  std::array<Mat3, 8> rotation;
  int count = 0;
  bool self_motion = false;  ///< complex solutions form a curve, real ones with it or none at all; no list
  bool reliable = true;      ///< false where the method failed: solutions may be missing
};

}  // namespace ninedof
