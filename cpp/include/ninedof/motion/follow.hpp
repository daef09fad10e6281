#pragma once
/// Inverse kinematics along a trajectory: what it needs of the legs, and what it meets.

#include <optional>
#include <vector>

#include "ninedof/dynamics/inverse_dynamics.hpp"
#include "ninedof/motion/derivatives.hpp"
#include "ninedof/motion/internal_points.hpp"
#include "ninedof/motion/limit_breaks.hpp"

namespace ninedof {

struct FollowSettings {
  TrajectoryRule rule;
  LegLimits limits;  ///< reported, and respected by TrajectoryRule::Kind::best only
  double characteristic_length = 1.0;  ///< of the condition number
  std::vector<Load> loads = {};       ///< one for each pose, or none
  std::optional<Masses> masses = {};  ///< their weights and inertia are added to the loads; without both no leg forces
  Vec3 gravity = Vec3::Zero();  ///< force per mass, base axes
  int threads = 0;  ///< 0: one for each processor. The result does not depend on it.
};

/// One entry for each pose, legs in the order of leg_lengths, base frame.
struct Followed {
  std::vector<Vec3> internal_point;
  std::vector<Vec9> leg_lengths, leg_rates, leg_accelerations;  ///< length, length/time, length/time^2
  PathDerivatives derivatives;  ///< of the platform and O
  std::vector<double> condition_number;  ///< infinite where singular
  std::vector<PerMechanism> singularity_margins;
  std::vector<Vec9> leg_forces;  ///< positive if the leg pushes
  std::vector<LimitBreak> breaks;
  /// How many poses from the first on `track` returns from the leg lengths, to 1e-9 and each step with its proof.
  std::size_t tracked = 0;
  /// Largest difference of a pose that it reached: of Q, and of p and O over the longest leg.
  double tracking_error = 0.0;
};

/// Places O by the rule and differentiates; the rates of the legs follow in closed form. As a check the lengths are
/// tracked back from the first pose.
///
/// Throws InvalidArgument for a trajectory, limits, characteristic length or loads that do not fit, and as
/// internal_points does; Stopped on a stop.
Followed follow(const Geometry& g, const Trajectory& trajectory, const Configuration& home,
                const FollowSettings& settings = {}, const Control& control = {});

}  // namespace ninedof
