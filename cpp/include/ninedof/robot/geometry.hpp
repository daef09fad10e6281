#pragma once
/// The geometry of the robot: the twelve joint centres, fixed once it is built.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// A C3 orbit: its first joint at (radius, angle) in the plane z = height, the others at -120 and -240 degrees from it,
/// the order in which eqs. (37)-(38) number the joints. Radius and height in length units, angle in radians.
struct Orbit {
  double radius = 0.0;
  double angle = 0.0;
  double height = 0.0;
};

/// The four joint triples r, r^ (base frame) and u, u~ (platform frame), in one length unit.
///
/// Immutable, finite, and not singular at every pose (architecture_singularity.hpp): internal joints span triangles,
/// external ones are not all in one point, and no two external legs have the same joints. External joints may be on a
/// line.
class Geometry {
 public:
  /// Throws InvalidArgument naming the triples if one is not finite or has zero size, an internal one is collinear
  /// (height of the triangle below 1e-9 of its longest side), or external legs coincide (ends apart by no more than
  /// 1e-9 of the longest sides).
  Geometry(const Triple& base_external, const Triple& base_internal, const Triple& platform_external,
           const Triple& platform_internal);

  /// The semi-regular hexagons of eqs. (37)-(38): sides a1, a2 (base) and b1, b2 (platform), lengths >= 0.
  /// Throws InvalidArgument for a negative or non-finite side, or a plate with both sides zero.
  static Geometry hexagonal(double a1, double a2, double b1, double b2);

  /// Four C3 orbits about z. Throws InvalidArgument for a radius that is not positive.
  static Geometry symmetric(const Orbit& base_external, const Orbit& base_internal, const Orbit& platform_external,
                            const Orbit& platform_internal);

  const Triple& base_external() const { return base_external_; }          ///< r_i, base frame
  const Triple& base_internal() const { return base_internal_; }          ///< r^_i, base frame
  const Triple& platform_external() const { return platform_external_; }  ///< u_i, platform frame
  const Triple& platform_internal() const { return platform_internal_; }  ///< u~_i, platform frame

 private:
  Triple base_external_, base_internal_, platform_external_, platform_internal_;
};

}  // namespace ninedof
