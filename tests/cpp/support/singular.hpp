#pragma once
/// Robots that are singular in one way and no other.

#include "support/support.hpp"

namespace support {

/// A point of the plane of a triple, off its centre.
inline Vec3 in_plane(const Triple& t, Random& random) {
  return t[0] + random.uniform(0.2, 0.5) * (t[1] - t[0]) + random.uniform(0.2, 0.5) * (t[2] - t[0]);
}

/// Kind 0: O in the plane of the lower joints (det B = 0); 1: in that of the upper ones (det C = 0); 2: on the line of
/// an external leg (det N = 0).
inline Robot random_singular_robot(Random& random, int kind) {
  Robot robot = random_robot(random);
  const Geometry& g = robot.geometry;
  Configuration& c = robot.configuration;
  if (kind == 0) {
    c.internal_point = in_plane(g.base_internal(), random);
  } else if (kind == 1) {
    c.internal_point = c.position + c.rotation * in_plane(g.platform_internal(), random);
  } else {
    const Vec3 foot = g.base_external()[1], head = c.position + c.rotation * g.platform_external()[1];
    c.internal_point = foot + random.uniform(0.3, 0.7) * (head - foot);
  }
  return robot;
}

}  // namespace support
