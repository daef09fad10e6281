#pragma once
/// Where in a region of poses numbers are least: a sample, then descents from the worst of it. The one search of a
/// region; what is looked for is given as numbers that are the worse the lower they are.

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "ninedof/domains/pose_numbers.hpp"
#include "ninedof/math/control.hpp"

namespace ninedof {

struct RegionSettings {
  long samples = 100'000;  ///< of region_sample
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: one per processor. The result does not depend on it
  double last_step = 1e-7;  ///< of a descent by coordinates, in parts of the region
  long most_starts = 0;     ///< of the descents of a number, from samples; 0: 6 to 24, by their number
  /// Poses where descents begin too: those of each number that is there within `near` of its least.
  std::vector<Vec6> known = {};
  double near = 0.05;
};

struct RegionExtremes {
  /// For every number, in the order of the groups: the ends of the descents from the lowest of different parts of the
  /// region, and the lowest of the sample where a descent is not worth while; of those at one pose, or in a place
  /// where the number does not change, the lowest. None where no pose has the number.
  std::vector<std::vector<MetNumber>> ends;
  long poses = 0;  ///< looked at

  /// The least of a number, which some pose has.
  const MetNumber& least(std::size_t number) const;
};

/// `make` gives every thread its own numbers. Throws InvalidArgument for a region or settings that do not fit, Stopped
/// on a stop.
RegionExtremes region_extremes(const Region& region, const std::function<std::unique_ptr<PoseNumbers>()>& make,
                               const RegionSettings& settings, const Control& control = {});

}  // namespace ninedof
