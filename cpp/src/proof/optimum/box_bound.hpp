#pragma once
/// What can be proved of all designs in one box, and where to cut it.

#include "proof/optimum/combination.hpp"

namespace ninedof::proof {

enum class Reason : unsigned char { domain, ranges, combination };

struct BoxBound {
  double condition_number = 1.0;  ///< no design in the box is below
  Reason reason = Reason::ranges;
  Combination combination;
  double at_middle = infinity;  ///< the condition number of the design in the middle is no greater
  std::size_t cut = 0;  ///< the coordinate along which the rows change most
};

/// Of designs that keep the limits. Stops at the first reason that reaches `target`.
BoxBound bound_box(const Box& box, const Chart& chart, double target, const RowLimits& limits);

/// The design in the middle of a box.
Box middle_of(const Box& box, const Chart& chart);

/// Where a box is cut: the geometric mean of the ends.
double middle_of(const Box& box, std::size_t k);

}  // namespace ninedof::proof
