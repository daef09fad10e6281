#pragma once
/// Why no design of a box has a condition number below the target.

#include "proof/checker/curves.hpp"
#include "proof/checker/designs.hpp"

namespace ninedof::checker {

struct Block {
  Positive g2, f2, w2;
};
struct Pieces {
  Block axial, transverse;
  Positive external2, upper2, lower2;
};

/// The two blocks of M and the squares of the leg lengths over a box, with their slopes.
Pieces pieces(const Box& b, int dimension);

/// By ranges alone.
bool by_ranges(const Pieces& p, const Domain& d);

/// Shares of the transverse block in the greatest and the least singular value; weights of two legs.
struct Weights {
  float max = 0.0F, min = 0.0F, external = 0.0F, upper = 0.0F;
};

/// By the mean value theorem for one combination of the rows.
bool by_combination(const Pieces& p, const Box& box, const Domain& d, const Weights& by);

}  // namespace ninedof::checker
