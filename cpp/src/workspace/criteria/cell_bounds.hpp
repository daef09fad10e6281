#pragma once
/// Bounds of leg lengths, and of the distance from the boundary of the region, over a whole cell.

#include <vector>

#include "workspace/chart.hpp"
#include "workspace/criteria/placement.hpp"

namespace ninedof {

/// What the bounds prove for all points of a cell. Both are false where they decide nothing.
struct Proof {
  bool outside = false;  ///< no point is allowed
  bool inside = true;    ///< legs and region allow all points
};

class CellBounds {
 public:
  CellBounds(const Geometry& g, const WorkspaceDomain& domain, const Chart& chart, const Placement& placement,
             const WorkspaceCriteria& criteria, const std::vector<int>& limited);

  /// Positions: the lengths have their extremes at the points of a box nearest to and farthest from a centre, so that
  /// the bounds are exact up to rounding. Orientations: the bounds approach the extremes as fast as the cell shrinks.
  Proof over(const Vec3& centre, const Vec3& half) const;

  /// Whether balls and boxes are inside only where these bounds prove it: positions with the same rotations throughout.
  bool covers_bodies() const { return chart_.positional() && !some_ && !legs_.empty(); }
  /// Radius of the largest ball of positions about x in which the legs of all rotations are within their limits.
  double clear(const Vec3& x) const;

  /// Whether the length of limited leg number n does not change: then it has no bounds, and any point decides.
  bool constant(std::size_t n) const { return constant_[n]; }

 private:
  /// A leg is the vector k x + at[r] for positions x with rotation r, or at[0] + Q(x) arm for orientations x.
  struct Leg {
    double low, high, k;
    std::vector<Vec3> at;
    Vec3 arm;
  };
  struct Range {
    double least, most;
  };
  Range length(const Leg& leg, std::size_t r, const Vec3& centre, const Vec3& half) const;
  Range turned(const Leg& leg, const Mat3& q, const Mat3& spin, const Vec3& half) const;
  Range region(const Vec3& centre, const Vec3& half) const;

  const Chart& chart_;
  std::vector<Leg> legs_;
  std::vector<bool> constant_;
  std::size_t rotations_;
  bool some_;       // one allowed rotation is enough
  double rounding_;  // of a length
};

}  // namespace ninedof
