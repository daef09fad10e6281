#pragma once
/// Angles between the legs at a body and their axes.

#include <array>

#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

/// The six legs at the base or at the platform and the axes of their joints.
class Cones {
 public:
  Cones(const Geometry& g, const ConeLimit& limit, bool platform, const Configuration& home);

  /// The limit less each angle, radians: l1 l2 l3 and the body's internal legs.
  std::array<double, 6> margins(const Configuration& c) const;

 private:
  std::array<Vec3, 6> directions(const Configuration& c) const;  // away from the joint, in the body's frame

  const Geometry& g_;
  double angle_;
  bool platform_;
  std::array<Vec3, 6> axis_;
};

}  // namespace ninedof
