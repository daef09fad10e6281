#pragma once
/// A result looked at once more, from the variables of its design alone.

#include "ninedof/optimize/region_study.hpp"

namespace ninedof {

/// Whether a design is an optimum.
struct OptimumCheck {
  double residual = 0.0;  ///< see Candidate::optimality_residual
  int active = 0;         ///< bounds and limits that are reached
  long steps = 0;         ///< 0 where no variable is free
  long better = 0;        ///< those of them to designs with a smaller objective, allowed or not
  double gain = 0.0;      ///< the largest relative improvement by an allowed design; 0: none
};

struct OptimumCheckSettings {
  long steps = 4000;
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: one per processor; the result does not depend on it
};

/// Steps of 1e-1, 1e-2, ... 1e-6 of each variable (or of the characteristic length, if that is larger), in turn.
inline constexpr int step_sizes = 6;

/// The first-order test, and random steps of these sizes. Half of the steps change every free variable, half about two
/// of them. A better design that violates limits is corrected once to first order, as few random steps from a corner of
/// what is allowed stay within it; limits may be violated as much as by the design itself.
///
/// `variables`: a full set. Throws InvalidArgument for variables that do not fit, Stopped on a stop.
OptimumCheck check_optimum(const Problem& problem, const Eigen::VectorXd& variables,
                           const OptimumCheckSettings& settings, const Control& control = {});

/// Where a design is worst over a region, by a search with random numbers of its own.
struct RegionCheck {
  double index = 0.0;   ///< the greatest value of the index
  double margin = 0.0;  ///< the least of a limit; infinite without limits
  /// By how much a limit is passed, or the index above the greatest at the poses of the problem, in logarithms; none
  /// where it is negative.
  double excess = 0.0;
  long poses = 0;                  ///< looked at
  std::optional<RegionMean> mean;  ///< where the objective is a mean
};

/// `problem` has the poses that were imposed, `variables` are a full set of it. Where the region places O, that is done
/// anew at every pose, from O at the poses imposed and within `leg_ranges`, which are checked too.
/// Throws InvalidArgument for a region or variables that do not fit, Stopped on a stop.
RegionCheck check_region(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                         const std::optional<LegLimits>& leg_ranges, std::uint64_t seed, const Control& control = {});

}  // namespace ninedof
