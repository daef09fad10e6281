#pragma once
/// What is minimized, and at which poses.

#include <limits>
#include <vector>

#include "ninedof/domains/pose.hpp"

namespace ninedof {

/// An index of one pose; the optimizer works with its logarithm.
enum class Index {
  condition_number,  ///< sigma_max / sigma_min of J', eq. (2)
  frobenius,         ///< the condition number in the Frobenius norm, eq. (4): smooth, 6 at best
  speed,             ///< 1 / sigma_min of J': largest leg speed for a twist of unit norm
  six_legged,        ///< condition number of the six-legged platform on the same plates; neutral pose, C3 families
};

/// How the poses are combined.
enum class Aggregate {
  worst,         ///< the largest
  mean_inverse,  ///< 1 / mean(1 / index): the global conditioning index, as a number to be minimized
  weighted,      ///< worst^weight * (that)^(1 - weight)
};

struct Objective {
  Index index = Index::condition_number;
  Aggregate aggregate = Aggregate::worst;
  double weight = 0.5;  ///< of the worst, where weighted
  /// Bound on the 2-norm condition number at every evaluated pose.
  double condition_limit = std::numeric_limits<double>::infinity();
  double neutral_condition_limit = std::numeric_limits<double>::infinity();  ///< the same at the neutral configuration
  std::vector<Pose> poses;  ///< none: the neutral configuration alone

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;
};

}  // namespace ninedof
