#pragma once
/// The largest mass that the legs can hold at a pose.

#include "ninedof/dynamics/inverse_dynamics.hpp"

namespace ninedof {

struct PayloadLimits {
  Vec9 push = Vec9::Zero(), pull = Vec9::Zero();  ///< greatest forces of each leg, >= 0; infinity leaves a side open
  Vec3 centre = Vec3::Zero();                     ///< of the payload, platform frame
  Vec3 gravity = Vec3::Zero();                    ///< force per mass, base axes
};

/// Throws InvalidArgument for a force that is negative or NaN, and for a centre or gravity that is not finite.
void validate(const PayloadLimits& limits);

using Vec18 = Eigen::Matrix<double, 18, 1>;

/// What a unit of payload takes of the room that each leg has below its greatest push, then above its greatest pull,
/// beside the load without it: leg forces are affine in the mass m, and a limit is kept where m x share <= 1. Smooth
/// where the room is positive; infinite where there is none, and at a singular configuration that a load moves.
Vec18 payload_shares(const Geometry& g, const Configuration& c, const PayloadLimits& limits, const Load& without);

/// The same of leg forces that are known, also in motion: `own` without the payload, `per_mass` of a unit of it, and
/// the greatest pushes and pulls at that instant.
Vec18 payload_shares(const Vec9& own, const Vec9& per_mass, const Vec9& push, const Vec9& pull);

/// The largest mass m >= 0 that keeps all limits; infinite where none is reached, NaN where the load without the
/// payload passes one.
double payload_of(const Vec18& shares);

}  // namespace ninedof
