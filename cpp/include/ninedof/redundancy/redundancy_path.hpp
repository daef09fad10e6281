#pragma once
/// Where O goes while the platform moves along a path: good at every pose, and smooth.

#include <span>
#include <vector>

#include "ninedof/math/control.hpp"
#include "ninedof/redundancy/redundancy.hpp"

namespace ninedof {

/// A pose of the platform.
struct PlatformPose {
  Vec3 position;
  Mat3 rotation;
};

/// Makes
///
///     mean of f(s_k) + smoothness (n - 1) sum |s_(k+1) - s_k|^2 / size^2
///
/// small, where f is the logarithm of the condition number, minus that of the least |det|, or the sum of squares, and size that of the
/// robot at the first pose: a mean along the path plus the mean square of the speed of O along it, so that finer steps change little.
///
/// Which local minimum to be in at which pose is chosen for the whole path at once (dynamic programming); the points then settle
/// together by Newton's method on the whole path, softened at first. O stays in one chamber, that of `start` at the first pose.
/// Poses that allow no point divide the path: on their two sides O is placed independently.
///
/// Throws InvalidArgument as best_internal_point does, and unless the smoothness is finite and positive; Stopped on a stop.
/// Reports the poses searched.
std::vector<InternalPoint> best_internal_path(const Geometry& g, std::span<const PlatformPose> poses,
                                              const InternalPointProblem& problem, double smoothness,
                                              const std::optional<Vec3>& start = {}, const Control& control = {});

}  // namespace ninedof
