#pragma once
/// The part of a certified workspace that is connected with home.

#include "workspace/certified/box_tree.hpp"

namespace ninedof::certified {

struct HomePiece {
  bool inside = false, outside = false;  ///< whether home is proved to be allowed, or not to be
  VolumeBounds volume;
};

/// Lower bound: home's box, and boxes joined to it by poses that are proved to be allowed. Upper bound: the boxes that
/// touch it or each other, without those proved to be outside.
HomePiece home_piece(const Tree& tree, const Vec3& home);

/// The sum over leaves of their volumes times their shares, rounded outward.
VolumeBounds volume_of_leaves(const Tree& tree, const std::vector<int>& low, const std::vector<int>& high);

}  // namespace ninedof::certified
