#pragma once
/// Why no design of a box has a condition number below the target.

#include "proof/checker/designs.hpp"

namespace ninedof::checker {

/// The box with what follows from the coordinates that are cut: of hexagons y, and U / l_c where it is none of them.
/// That is inverted where the box holds no design.
void settle(Box& box, const Domain& d);

/// By ranges alone.
bool by_ranges(const Box& box, const Domain& d);

/// Shares of the transverse block in the greatest and the least singular value; weights of the external and the upper
/// leg, of R, zp, zs and the distances of the internal joints of base and platform.
struct Weights {
  float max = 0.0F, min = 0.0F;
  std::array<float, 7> limits{};
};

/// The bound that a weight above or below 0 holds a size to, in l_c; 0 if there is none.
double bound_of(const Domain& d, std::size_t limit, float weight);

/// By the mean value theorem for one combination of the rows.
bool by_combination(const Box& box, const Domain& d, const Weights& by);

}  // namespace ninedof::checker
