#pragma once
/// Bounds over a whole cell: of leg lengths, of angles from the axes of joints, and of the distance from the boundary
/// of the region.

#include <ranges>
#include <vector>

#include "workspace/chart.hpp"
#include "workspace/criteria/convex_cone.hpp"
#include "workspace/criteria/placement.hpp"

namespace ninedof {

/// What the bounds prove for all points of a cell. Both are false where they decide nothing.
struct Proof {
  bool outside = false;  ///< no point is allowed
  bool inside = true;    ///< legs, cones and region allow all points
};

/// The cones of the joints of a body, with the axes that they have, in its frame.
struct BodyCones {
  bool platform;
  double angle;
  int first = 0;           ///< of the legs of the body
  std::vector<Vec3> axis;  ///< of each leg from there on

  auto legs() const { return std::views::iota(first, first + static_cast<int>(axis.size())); }
};

class CellBounds {
 public:
  /// Of the legs in `limited`, and of all legs at the bodies of `cones`, in that order.
  CellBounds(const Geometry& g, const WorkspaceDomain& domain, const Chart& chart, const Placement& placement,
             const LegLimits& limits, const std::vector<int>& limited, const std::vector<BodyCones>& cones);

  /// Positions: the lengths have their extremes at the points of a box nearest to and farthest from a centre, so that
  /// the bounds are exact up to rounding; allowed directions are a convex cone, or those not allowed. Orientations: the
  /// bounds approach the extremes as fast as the cell shrinks.
  Proof over(const Vec3& centre, const Vec3& half) const;

  /// Whether balls and boxes are inside only where these bounds prove it: positions with the same rotations throughout.
  bool covers_bodies() const { return chart_.positional() && !some_ && !(legs_.empty() && cones_.empty()); }
  /// Radius of the largest ball of positions about x in which the legs of all rotations are within their limits.
  double clear(const Vec3& x) const;

  /// Whether leg number n of those given does not change: then it has no bounds, and any point decides.
  bool constant(std::size_t n) const { return constant_[n]; }

 private:
  /// A leg is the vector k x + at[r] for positions x with rotation r, or at[0] + Q(x) arm for orientations x.
  struct Line {
    double k;
    std::vector<Vec3> at;
    Vec3 arm;
  };
  struct Leg : Line {
    double low, high;
  };
  /// A leg from its joint, base frame, and its cone with each rotation; for orientations in the body's frame.
  struct ConedLeg : Line {
    std::vector<ConvexCone> cone;
    bool of_platform;
  };
  struct Range {
    double least, most;
  };
  Range length(const Leg& leg, std::size_t r, const Vec3& centre, const Vec3& half) const;
  Range turned(const Leg& leg, const Mat3& q, const Mat3& spin, const Vec3& half) const;
  Proof coned(const ConedLeg& leg, std::size_t r, const Mat3& q, const Vec3& centre, const Vec3& half) const;
  Range region(const Vec3& centre, const Vec3& half) const;

  const Chart& chart_;
  std::vector<Leg> legs_;
  std::vector<ConedLeg> cones_;
  std::vector<bool> constant_;
  std::size_t rotations_;
  bool some_;       // one allowed rotation is enough
  double size_ = 0.0, rounding_ = 0.0;  // of a length
};

}  // namespace ninedof
