#pragma once
/// Direct position analysis with a proof: how many configurations have nine leg lengths, and where each of them is.

#include <vector>

#include "ninedof/position/assembly_modes.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// A box of configurations that may hold assembly modes: none, one or several.
struct UndecidedModes {
  Configuration middle;
  double radius;  ///< as those of CertifiedModes; infinite if O or the rotation is unknown
  int base_side, platform_side;  ///< of O, as in AssemblyMode; 0 if O may lie on either side
};

struct CertifiedModes {
  /// As forward_position has them, followed by proved ones that it missed.
  AssemblyModes modes;
  /// Of each mode: one exact configuration lies so near, in every entry of Q, and in every coordinate of p and O as a
  /// fraction of the longest leg. Infinite where no mode was proved there.
  std::array<double, 32> radius{};
  int proved = 0;  ///< configurations that exist, each counted once; there are no others if nothing is undecided
  std::vector<UndecidedModes> undecided;
  long boxes = 0;  ///< boxes of rotations examined

  /// Whether the number of modes is proved.
  bool complete() const { return undecided.empty(); }
};

/// Every assembly mode, enclosed, and a proof that there is no other (docs/theory/position.md): for exactly these
/// joints and lengths, by interval arithmetic and Krawczyk's operator. A double mode is undecided, as is O in a plane
/// of internal joints. Half a millisecond, a hundred times the time of forward_position; tens of milliseconds where
/// nothing can be decided.
///
/// Throws as forward_position does, and std::runtime_error as require_sound_arithmetic does.
CertifiedModes certified_modes(const Geometry& g, const Vec9& leg_lengths);

}  // namespace ninedof
