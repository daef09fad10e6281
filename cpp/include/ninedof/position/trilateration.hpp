#pragma once
/// Three spheres: where O is, seen from one plate.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// The plane of three centres and the frame in it. Depends on the geometry only.
struct SphereCentres {
  explicit SphereCentres(const Triple& centres);

  Triple centre;
  Vec3 e1, e2, e3;  ///< e1 towards the second centre, e3 = (c2 - c1) x (c3 - c1), unit
  double length;    ///< |c2 - c1|
  double i, j;      ///< third centre in the frame

  /// Height of a point above the plane.
  double height(const Vec3& point) const { return e3.dot(point - centre[0]); }
  /// Its mirror image.
  Vec3 mirrored(const Vec3& point) const { return point - (2.0 * height(point)) * e3; }
};

/// How three spheres meet.
struct Meeting {
  enum Kind { none, touching, two_points } kind = none;
  double height2 = 0.0;  ///< squared height over the plane of the centres; negative where the spheres do not meet
  Vec3 above;  ///< the point on the side of e3; the other is its mirror image. In the plane where they touch.
};

/// Squared heights within what rounding can make of them are the tangent case: the height itself is then good to half the digits.
Meeting meet(const SphereCentres& at, const Vec3& radii);

}  // namespace ninedof
