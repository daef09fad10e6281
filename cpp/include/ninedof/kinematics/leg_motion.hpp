#pragma once
/// Speeds and accelerations of the legs for a motion of the platform, in any direction or a given one, while O follows
/// a rule.

#include <optional>

#include "ninedof/kinematics/acceleration.hpp"

namespace ninedof {

/// How O moves with the platform.
enum class InternalMotion {
  least,    ///< squared leg rates, and squared leg accelerations, are least
  held,     ///< not at all
  shifted,  ///< with p: s - p is constant in base axes
  carried,  ///< as a point of the platform
};

/// A twist of the platform and its time derivative, (omega, pdot), base axes.
struct TwistMotion {
  Vec6 twist = Vec6::Zero();
  Vec6 rate = Vec6::Zero();
};

struct PlatformMotion {
  InternalMotion internal = InternalMotion::least;
  double linear_speed = 1.0;         ///< of the platform's origin, length/time
  double angular_speed = 0.0;        ///< rad/time
  std::optional<TwistMotion> given;  ///< a motion besides those in all directions
};

/// Rates of the legs for a twist.
Vec9 leg_rates(const Geometry& g, const Configuration& c, InternalMotion internal, const Vec6& twist);

/// Accelerations of the legs. NaN for a leg of no length.
Vec9 leg_accelerations(const Geometry& g, const Configuration& c, InternalMotion internal, const TwistMotion& motion);

/// The largest rate of each leg over all directions of both velocities: linear_speed |a| + angular_speed |b|, where its
/// rate is a.pdot + b.omega.
Vec9 largest_leg_rates(const Geometry& g, const Configuration& c, const PlatformMotion& motion);

/// The largest acceleration of each leg over all directions while both velocities are constant; where neither speed is
/// 0, a bound of it: of the quadratic form of the twist the 2-norms of its blocks are added. Infinite for a leg of no
/// length.
Vec9 largest_leg_accelerations(const Geometry& g, const Configuration& c, const PlatformMotion& motion);

}  // namespace ninedof
