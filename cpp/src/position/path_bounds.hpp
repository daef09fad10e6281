#pragma once
/// How far O moves while leg lengths go straight from one set to another (docs/theory/position.md).

#include "ninedof/position/trilateration.hpp"

namespace ninedof {

/// O in the frame of one plate, and its distances from the three joints.
struct PlatePoint {
  PlatePoint(const SphereCentres& plate, const Vec3& point, const Vec3& radii);

  double x, y, height;  ///< along e1, e2, e3 from the first joint
  Vec3 radii;
};

/// Bounds for O(t), 0 <= t <= 1, while the three lengths change linearly.
struct PathBounds {
  double speed;         ///< |O'(t)| is at most this: infinite where O may reach the plane of the joints
  double acceleration;  ///< |O''(t)| is at most this
};

PathBounds path_bounds(const SphereCentres& plate, const PlatePoint& from, const PlatePoint& to);

}  // namespace ninedof
