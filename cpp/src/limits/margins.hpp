#pragma once
/// What a value leaves of a limit, negative where the limit is violated: for the solver, and for cells of workspaces.
/// What people read is `margin` of ninedof/limits/limits.hpp.

#include "ninedof/limits/limits.hpp"

namespace ninedof {

/// The margin that the optimizer works with, of a value v and a limit.
enum class SolverMargin {
  logarithm,  ///< log(high / v), log(v / low): for positive values
  linear,     ///< 1 - v / high, v / low - 1
  plain,      ///< v - low
  mixed       ///< 1 - v / high where it is kept, log(high / v) beyond: for values that may be 0 or infinite
};

double solver_margin(SolverMargin form, Side side, double limit, double value);
/// Its derivative by the value; 0 for a logarithm that has none.
double solver_slope(SolverMargin form, Side side, double limit, double value);
/// The value that has this margin.
double value_at_margin(SolverMargin form, Side side, double limit, double margin);

/// A margin as people read it, and its derivative by that of the solver.
struct ShownMargin {
  double value, slope;
};
ShownMargin share_of_limit(SolverMargin form, Side side, double margin);

/// The margin that cells of a workspace interpolate: smooth across the limit, in the unit of the value. Of what may be
/// infinite, the slope of log(limit / value) at the limit.
double cell_margin(LimitKind kind, Side side, double limit, double value);

}  // namespace ninedof
