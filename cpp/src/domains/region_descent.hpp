#pragma once
/// One descent of one number over a region, from a pose; and which ends of some are the same.

#include <stop_token>
#include <vector>

#include "ninedof/domains/pose_numbers.hpp"

namespace ninedof {

/// A number among those of poses.
struct NumberPlace {
  int group, number;
  int size;  ///< of the group
};

/// Lowers `met`, by the slopes of a smooth number, else by coordinates. Returns how many poses were looked at.
long descend(PoseNumbers& pose, const Region& region, const NumberPlace& place, double last_step,
             const std::stop_token& stop, MetNumber& met);

/// The same of a smooth number by a few steps, without a look around: nearly lowest, for a number that is dear.
long descend_a_little(PoseNumbers& pose, const Region& region, const NumberPlace& place, const std::stop_token& stop,
                      MetNumber& met);

/// Keeps the lowest of ends at one pose, and of those as low as each other between which the number does not change:
/// the length of a leg may not depend on the tilt. Returns how many poses were looked at.
long drop_repeated(PoseNumbers& pose, const Region& region, const NumberPlace& place, std::vector<MetNumber>& ends);

}  // namespace ninedof
