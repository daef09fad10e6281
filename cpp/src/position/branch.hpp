#pragma once
/// One branch of the direct position problem: O fixed in both frames, all rotations that fit the external legs.

#include "ninedof/position/assembly_modes.hpp"
#include "position/rotation_problem.hpp"

namespace ninedof {

/// A solution of the rotation problem and its separation from the nearest other one.
struct BranchMode {
  Mat3 rotation;
  double separation;
  bool simple;  ///< false if it meets another one within the error of the equations
};

/// Bounds of the errors of O in both frames, and the largest of all leg lengths.
struct BranchScale {
  double s_error, o_error;
  double unit;
};

struct Branch {
  int count = 0;
  std::array<BranchMode, 8> mode;
  std::array<bool, 3> misfit{};  ///< external legs too long or too short for the position of O: one excludes all modes
  bool self_motion = false;
  bool certain = true;
  bool null_space = false;  ///< whether the null-space method was used
};

Branch solve_branch(const Geometry& g, const InternalPoints& at, const Vec3& external_lengths, const BranchScale& scale,
                    RotationMethod method);

}  // namespace ninedof
