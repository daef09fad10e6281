#pragma once
/// Limits of the longest and the shortest length over all poses together, as rows over every number type.

#include <algorithm>
#include <cmath>
#include <limits>

#include "ninedof/math/interval.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

template <class T>
T length_ratio(const T& longest, const T& shortest) {
  return longest / shortest;
}
/// A shortest length whose enclosure touches 0 leaves no upper end.
inline Interval length_ratio(const Interval& longest, const Interval& shortest) {
  return {std::max(detail::below(longest.lo / shortest.hi), 0.0),
          shortest.lo > 0.0 ? detail::above(longest.hi / shortest.lo) : std::numeric_limits<double>::infinity()};
}

struct SpreadRow {
  bool ratio = true;     ///< the quotient of the two lengths; else their difference
  bool each_leg = true;  ///< of every leg on its own; else of all legs

  /// The number that people read.
  template <class T>
  T of(const T& longest, const T& shortest) const {
    return ratio ? length_ratio(longest, shortest) : longest - shortest;
  }
  int items() const { return each_leg ? 9 : 1; }
  double number(const Vec9& longest, const Vec9& shortest, int leg) const {
    return each_leg ? of(longest[leg], shortest[leg]) : of(longest.maxCoeff(), shortest.minCoeff());
  }

  // As a difference of measures, one of each length in parts of `size`: that of the solver. It may be `width`.

  double measured(double length, double size) const { return ratio ? std::log(length / size) : length / size; }
  double length(double measure, double size) const { return size * (ratio ? std::exp(measure) : measure); }
  /// The slope of `measured` is one over this.
  double slope_over(double length, double size) const { return ratio ? length : size; }
  double width(double limit) const { return ratio ? std::log(limit) : 1.0; }

  /// As planes in both lengths: longest <= share shortest, and for a difference the limit more.
  double share(double limit) const { return ratio ? limit : 1.0; }
};

}  // namespace ninedof
