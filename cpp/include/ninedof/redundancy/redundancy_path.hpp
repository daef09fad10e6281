#pragma once
/// Internal points along a path of the platform: good at every pose, and smooth.

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

/// Whether the last pose is the first (to 1e-12, lengths in parts of the largest coordinate) and another lies between
/// them; of four poses at least.
bool is_closed(std::span<const PlatformPose> poses);

/// Minimises
///
///     mean of f(s_k) + smoothness (n - 1) sum |s_(k+1) - s_k|^2 / size^2
///
/// where f is the logarithm of the condition number, minus that of the least |det|, or the sum of squares, and size
/// that of the robot at the first pose: a mean along the path plus the mean square of the speed of O along it. Finer
/// steps therefore change the result little.
///
/// Dynamic programming selects one local minimum at each pose for the whole path. Newton's method on the whole path,
/// first with a smoothed criterion, then moves all points together. O stays in one chamber, that of `start` at the
/// first pose. Poses that allow no point divide the path: on their two sides O is placed independently. On a closed
/// path both ends have the same O and value, and the sum has the move from the last pose but one to the first.
///
/// Reports the poses searched, for a closed path anew in each of its attempts. Throws InvalidArgument as
/// best_internal_point does, and unless the smoothness is finite and positive; Stopped on a stop.
std::vector<InternalPoint> best_internal_path(const Geometry& g, std::span<const PlatformPose> poses,
                                              const InternalPointProblem& problem, double smoothness,
                                              const std::optional<Vec3>& start = {}, const Control& control = {});

}  // namespace ninedof
