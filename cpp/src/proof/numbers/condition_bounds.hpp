#pragma once
/// From bounds of singular values to those of their ratios.

#include <algorithm>

#include "ninedof/math/interval.hpp"

namespace ninedof {

/// a / b for a, b >= 0: infinite where b may be zero.
inline Interval ratio_bounds(const Interval& a, const Interval& b) {
  const double lo = b.hi > 0.0 ? detail::below(std::max(a.lo, 0.0) / b.hi) : detail::no_bound;
  return {std::max(lo, 0.0), b.lo > 0.0 ? detail::above(a.hi / b.lo) : detail::no_bound};
}

/// A condition number is at least 1.
inline Interval at_least_one(const Interval& x) {
  return {std::max(x.lo, 1.0), std::max(x.hi, 1.0)};
}

}  // namespace ninedof
