#pragma once
/// The three coordinates that a workspace is a set of, the poses they stand for and their measure.

#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

class Chart {
 public:
  explicit Chart(const WorkspaceDomain& domain);

  bool positional() const { return positional_; }
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }
  double box_volume() const { return (high_ - low_).prod(); }

  /// Volume by unit of the coordinates: 1, or Haar's measure with 8 pi^2 for all of SO(3).
  double density(const Vec3& x) const;
  double volume() const;

  /// Whether the box holds points that are not of the region, and how far x is inside.
  bool has_region() const { return !positional_; }
  double region_margin(const Vec3& x) const;
  /// The first axis at whose ends the box is a wall: all for positions, torsion alone, none (3) for rotation vectors.
  int first_wall() const;

  /// How fast the rotation can turn, radians by unit of the coordinates.
  double turning() const;

  Mat3 rotation(const Vec3& x) const;
  /// The coordinates of a rotation; the inverse of the above.
  Vec3 coordinates(const Mat3& q) const;

 private:
  bool positional_;
  OrientationRegion region_;
  Mat3 centre_;
  Vec3 low_, high_;
};

}  // namespace ninedof
