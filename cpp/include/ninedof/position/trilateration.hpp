#pragma once
/// The common points of three spheres: the position of O relative to the base or to the platform.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// The plane of three sphere centres with a frame in it. Depends on the geometry only.
struct SphereCentres {
  explicit SphereCentres(const Triple& centres);

  Triple centre;
  Vec3 e1, e2, e3;  ///< e1 towards the second centre, e3 = (c2 - c1) x (c3 - c1), unit
  double length;    ///< |c2 - c1|
  double i, j;      ///< coordinates of the third centre along e1 and e2

  /// Height of a point above the plane.
  double height(const Vec3& point) const { return e3.dot(point - centre[0]); }
  /// The mirror image of a point in the plane.
  Vec3 mirrored(const Vec3& point) const { return point - (2.0 * height(point)) * e3; }
};

/// The intersection of three spheres.
struct Meeting {
  enum Kind { none, touching, two_points } kind = none;
  double height2 = 0.0;  ///< squared height over the plane of the centres; negative where the spheres do not meet
  Vec3 above;  ///< the point on the side of e3; the other one is its mirror image. In the plane if the spheres touch.
  double error = 0.0;  ///< bound of the distance of `above` from the exact point, for radii correct to rounding
  bool certain = true;  ///< whether `kind` none is proved; false where numbers overflowed or underflowed
};

/// A squared height within its rounding error counts as touching: the height is then accurate to half the digits.
Meeting meet(const SphereCentres& at, const Vec3& radii);

}  // namespace ninedof
