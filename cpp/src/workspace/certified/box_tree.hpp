#pragma once
/// The boxes of a certified workspace: a tree, each box either whole or halved.

#include "workspace/certified/limits_over_box.hpp"

namespace ninedof::certified {

/// What is known of a box. Its allowed part is between two shares of its volume.
struct Seen {
  struct Left {
    std::uint32_t rotation;
    Criteria open;
  };
  bool looked = false;
  double low = 0.0, high = 1.0;
  std::vector<Left> left;  ///< what a half has to look at
  std::vector<Cut> cuts;   ///< of the box where it is neither inner nor outer
  bool inner() const { return low == 1.0; }
  bool outer() const { return high == 0.0; }
};

struct Node {
  PositionBox box;
  Seen seen;
  int first_half = -1;  ///< the other follows it; -1 for a leaf
  bool leaf() const { return first_half < 0; }
};

using Tree = std::vector<Node>;  ///< the root is the first

inline Interval volume_of(const PositionBox& box) {
  Interval out(1.0);
  for (int k = 0; k < 3; ++k) out = out * (Interval(box.high[k]) - box.low[k]);
  return max(out, 0.0);
}

/// Looks at a box: what was open in the box that it is a part of.
Seen seen_of(const LimitsOverBox& cuts, const PositionBox& box, const std::vector<Seen::Left>& left, bool some);

/// Whether the point of a box, on its boundary or inside, is proved to be allowed.
bool proved_at(const Node& leaf, const Vec3& x);

}  // namespace ninedof::certified
