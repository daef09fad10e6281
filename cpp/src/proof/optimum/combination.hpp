#pragma once
/// The best combination of the rows of a box: what it proves of all designs in it.

#include "proof/optimum/axis_rows.hpp"

namespace ninedof::proof {

/// Weights of the rows: those of the two greatest singular values add to 1, those of the two least to -1, those of the
/// legs to 0. For designs whose longest and shortest leg differ by a factor L at most, and any such weights,
///   log kappa >= sum of weight * row - spread log L,   spread: the sum of the positive weights of legs.
/// Floats: a certificate keeps them.
struct Combination {
  float max = 0.0F, min = 0.0F;         ///< share of the transverse one, from 0 to 1
  float external = 0.0F, upper = 0.0F;  ///< weights of these legs; the lower leg has the rest
  std::array<Interval, rows> weights() const;
  Interval spread() const;
};

/// Largest distance of a box from its middle, in the logarithms of its coordinates.
using Radii = std::array<double, coordinates>;

/// Of log kappa over the box, whose lower end is the statement: the values at the middle, less what the slopes over the
/// box can take away.
Interval combined(const Combination& by, const Values& at_middle, const std::array<Slopes, rows>& slopes,
                  const Radii& radius, std::size_t dimension, double log_leg_ratio);

/// Nearly the best combination for `combined`, by the simplex method in plain doubles. An infinite leg ratio: no legs.
Combination best_combination(const Values& at_middle, const std::array<Slopes, rows>& slopes, const Radii& radius,
                             std::size_t dimension, double log_leg_ratio);

}  // namespace ninedof::proof
