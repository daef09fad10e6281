#pragma once
/// The frame in which a machine is used. Plates are designed in their own frame; geometries, configurations and all
/// that follows have the tool's frame as that of the platform: p is the tool's point, Q has its axes.

#include "ninedof/math/rotation.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

struct Tool {
  Vec3 position = Vec3::Zero();  ///< of its point in the platform's own frame
  Vec3 rotation = Vec3::Zero();  ///< rotation vector from the platform's axes to its own, radians

  /// Whether its point lies on the axis of the platform: a symmetric design stays symmetric.
  bool on_axis() const { return position.x() == 0.0 && position.y() == 0.0; }
  bool turned() const { return !rotation.isZero(0.0); }
  /// Its axes, as columns in the platform's own frame.
  Mat3 axes() const { return turned() ? exp_rotation(rotation) : Mat3::Identity(); }

  /// The same robot with platform joints in the tool's frame: exact where it is not turned and the sums are exact.
  Geometry seen(const Geometry& own) const;

  /// Throws InvalidArgument if a number is not finite.
  void validate() const;
};

}  // namespace ninedof
