#pragma once
/// The ranges in which limits that compare poses let the legs be at every pose.

#include <limits>
#include <string>
#include <vector>

#include "ninedof/limits/spread_row.hpp"
#include "ninedof/problem/problem.hpp"
#include "ninedof/redundancy/redundancy.hpp"

namespace ninedof {

/// The range in which a limit that compares poses lets each leg be at every pose: of its length in parts of `size`, or
/// of the logarithm of that.
struct LegRange {
  std::string limit;
  Vec9 low = Vec9::Zero(), high = Vec9::Zero();
  double size = 1.0;
  SpreadRow spread;
  bool in_zp = false;  ///< whether the size is proportional to zp
  double most = std::numeric_limits<double>::infinity();  ///< the limit of longest / shortest, or of their difference

  /// A length as the range measures it, and the length of such a measure.
  double measured(double length) const { return spread.measured(length, size); }
  double length(double measure) const { return spread.length(measure, size); }

  /// high - low
  double width() const { return spread.width(most); }

  /// Sets the size of a difference for a design of this zp.
  void set_zp(double zp);

  /// Sets the ends. What the limit leaves beyond these lengths is divided evenly between the two: for a ratio in
  /// logarithms.
  void surround(const Vec9& shortest, const Vec9& longest);
};

/// The range of given lengths, by their logarithms in parts of a size.
LegRange range_of(const LegLimits& lengths, double size = 1.0);

/// A range for each limit of a problem on strokes and leg ratios at its poses, without ends and for zp = 1.
std::vector<LegRange> leg_ranges(const Problem& problem);

/// The same for a design of this zp, about its leg lengths at some poses. Throws InvalidArgument for no lengths.
std::vector<LegRange> leg_ranges(const Problem& problem, double zp, const std::vector<Vec9>& lengths);

/// The least and greatest length of each leg that all ranges and limits allow.
LegLimits common_range(const std::vector<LegRange>& ranges, const LegLimits& limits);

}  // namespace ninedof
