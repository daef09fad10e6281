#pragma once
/// What is looked for over a region: numbers of its poses, the worse the lower they are.

#include <limits>
#include <vector>

#include "ninedof/domains/region.hpp"

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

/// A number, and the coordinates of the pose where it was met.
struct MetNumber {
  double value;
  Vec6 at;
};

}  // namespace ninedof
