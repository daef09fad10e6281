#pragma once
/// Where in a region of poses numbers are least: a sample, then descents from the worst of it. The one search of a
/// region; what is looked for is given as numbers that are the worse the lower they are.

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "ninedof/domains/region.hpp"
#include "ninedof/math/control.hpp"

namespace ninedof {

/// Numbers of a pose, in groups that are computed together. NaN, where a pose has no number, is never least.
class PoseNumbers {
 public:
  virtual ~PoseNumbers() = default;
  /// How many numbers each group has.
  virtual std::vector<int> groups() const = 0;
  /// Goes to a pose of the region.
  virtual void go(const Vec6& at) = 0;
  /// The numbers of a group there; `out` has room for them.
  virtual void evaluate(int group, double* out) = 0;
  /// Whether a number is smooth, so that it has `slopes`: then descents follow them. They go by coordinates otherwise.
  virtual bool smooth(int /*group*/, int /*number*/) const { return false; }
  /// One number of a group at a pose of the region or beside it, and its derivatives by the coordinates.
  virtual double slopes(int /*group*/, int /*number*/, const Vec6& /*at*/, Vec6& /*by_at*/) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  /// Below which value of each number a descent is worth while, for the least values of the sample; always by default.
  virtual std::vector<double> worthwhile(const std::vector<double>& sampled) const {
    return std::vector<double>(sampled.size(), std::numeric_limits<double>::infinity());
  }
};

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

/// A number, and the coordinates of the pose where it was met.
struct MetNumber {
  double value;
  Vec6 at;
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
