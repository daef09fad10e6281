#pragma once
/// When a motion passes its limits or a singularity.

#include <span>
#include <string>
#include <vector>

#include "ninedof/limits/limits.hpp"
#include "ninedof/redundancy/redundancy.hpp"
#include "ninedof/singularity/singularity.hpp"

namespace ninedof {

/// A stretch of time in which a limit is not kept.
struct LimitBreak {
  std::string limit;  ///< "l1 low": the leg is shorter than its limit; "q2 high": longer; "det B": a singularity
  double begin, end;  ///< times, interpolated linearly between the samples
  double worst;       ///< the value that is limited, 0 for a determinant that changes its sign
  double at;          ///< the time of the worst
};

/// The stretches in which a margin is below -tolerance. `values` are those that are limited; one of each for each time.
std::vector<LimitBreak> stretches(const std::string& limit, std::span<const double> time,
                                  std::span<const double> values, std::span<const double> margin,
                                  double tolerance = margin_tolerance);

/// Where a determinant changes its sign; a sample of 0 counts too.
std::vector<LimitBreak> crossings(const std::string& name, std::span<const double> time,
                                  std::span<const double> determinant);

/// What leg lengths leave of their limits, in parts of them, negative where one is passed: (length - low) / low and
/// (high - length) / high. Infinite where a limit is 0 or infinite, which means none.
struct LegMargins {
  Vec9 low, high;
};
LegMargins leg_margins(const Vec9& lengths, const LegLimits& limits);

/// The stretches in which legs pass their limits and the singularities passed, the earliest first. One entry of lengths
/// and determinants for each of the increasing times; throws InvalidArgument for another number.
std::vector<LimitBreak> limit_breaks(std::span<const double> time, std::span<const Vec9> lengths,
                                     const LegLimits& limits, std::span<const PerMechanism> determinants);

}  // namespace ninedof
