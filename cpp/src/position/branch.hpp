#pragma once
/// One branch of the direct position problem: O fixed in both plates, all rotations that fit the external legs.

#include "ninedof/position/assembly_modes.hpp"
#include "position/internal_point.hpp"

namespace ninedof {

/// A solution of the rotation problem and how far it is from meeting another.
struct BranchMode {
  Mat3 rotation;
  double separation;
};

struct Branch {
  int count = 0;
  std::array<BranchMode, 8> mode;
  std::array<bool, 3> misfit{};  ///< external legs too long or too short for O where it is: each alone leaves no mode
  bool self_motion = false;
  bool certain = true;
  bool null_space = false;  ///< the fast elimination was not enough
};

/// `unit` is the largest of all leg lengths.
Branch solve_branch(const Geometry& g, const InternalPoints& at, const Vec3& external_lengths, double unit,
                    RotationMethod method);

}  // namespace ninedof
