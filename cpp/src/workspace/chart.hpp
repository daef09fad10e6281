#pragma once
/// The chart of a workspace: three coordinates, the poses they represent, and their measure.

#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

class Chart {
 public:
  explicit Chart(const WorkspaceDomain& domain);

  bool positional() const { return positional_; }
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }
  double box_volume() const { return (high_ - low_).prod(); }

  /// Volume per unit of the coordinates: 1, or Haar's measure with 8 pi^2 for all of SO(3).
  double density(const Vec3& x) const;
  double volume() const;

  /// Whether the region is smaller than its box, and the distance of x from its boundary, positive inside.
  bool has_region() const { return !positional_; }
  double region_margin(const Vec3& x) const;
  /// First axis on which faces of the box limit the workspace: 0 for positions, 2 (torsion), 3 (none) for vectors.
  int first_wall() const;

  /// Greatest rotation, in radians, per unit of the coordinates.
  double turning() const;
  /// Angular velocity, base frame, per unit of each coordinate: the columns.
  Mat3 spin(const Vec3& x) const;
  /// Bound of the second derivative of Q w along a line of unit speed, for a unit vector w.
  double bending() const;

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
