#pragma once
/// How much of a ball or a box is allowed.

#include "workspace/criteria/limits_at_points.hpp"

namespace ninedof {

/// A ball, or a box with edges along the axes. Half the sides of a ball are its radius.
struct Body {
  Vec3 centre, half;
  bool box;

  /// The point of the scaled surface in a direction.
  Vec3 at(const Vec3& way, double scale) const {
    return centre + scale / (box ? way.cwiseAbs().maxCoeff() : way.norm()) * way.cwiseProduct(half);
  }
};

/// The greatest scale, at most 1, at which no forbidden point of a body is found. For positions, other than reachable
/// ones, leg lengths are proved to be within their limits in all of it. The other criteria are sampled: on 500 rays,
/// at several depths, and on the surface down to the least margins near the worst of these rays. Throws Stopped.
double allowed_scale(const Body& body, const LimitsAtPoints& margins, const Control& control);

}  // namespace ninedof
