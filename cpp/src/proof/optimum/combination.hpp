#pragma once
/// The best combination of the rows of a box: what it proves of all designs in it.

#include "math/numbers.hpp"
#include "proof/optimum/axis_rows.hpp"

namespace ninedof::proof {

/// What the rows of legs and sizes are held to.
struct RowLimits {
  double log_leg_ratio = infinity;
  Sizes size{};  ///< in l_c; from 0 to infinity where nothing is known
  RowLimits() { size.fill({0.0, infinity}); }
};

/// Weights of the rows: those of the two greatest singular values add to 1, those of the two least to -1, those of the
/// legs to 0. For designs whose longest and shortest leg differ by a factor L at most, and any such weights,
///   log kappa >= sum of weight * row - spread log L - sum of weight * log bound,
/// spread: the sum of the positive weights of legs; the second sum: over the sizes, each with its upper bound where its
/// weight is positive, else with its lower one. Floats: a certificate keeps them.
struct Combination {
  float max = 0.0F, min = 0.0F;  ///< share of the transverse one, from 0 to 1
  /// Weights of the external and the upper leg, of which the lower leg has the rest, and of the sizes.
  std::array<float, 2 + sizes> limits{};
  bool limited() const;
  bool legs() const;
  std::array<Interval, rows> weights() const;
  /// The two sums that the limits take away.
  Interval held(const RowLimits& limits) const;
};

/// Largest distance of a box from its middle, in the logarithms of its coordinates.
using Radii = std::array<double, coordinates>;

/// Of log kappa over the box, whose lower end is the statement: the values at the middle, less what the slopes over the
/// box can take away.
Interval combined(const Combination& by, const Values& at_middle, const std::array<Slopes, rows>& slopes,
                  const Radii& radius, std::size_t dimension, const RowLimits& limits);

/// Nearly the best combination for `combined`, by the simplex method in plain doubles. Rows without a limit have no
/// weight.
Combination best_combination(const Values& at_middle, const std::array<Slopes, rows>& slopes, const Radii& radius,
                             std::size_t dimension, const RowLimits& limits);

}  // namespace ninedof::proof
