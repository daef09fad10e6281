#pragma once
/// A box of designs divided by planes alone: no number of the machine is looked at again.

#include <vector>

#include "proof/admissible/climb.hpp"

namespace ninedof::admissible {

/// What is known of a box of designs: inside where all cuts are positive, if they are all there is; outside where a
/// loss is negative.
struct Knowledge {
  bool complete = false;
  std::vector<Plane> cuts;
  std::vector<Loss> losses;
};

struct Piece {
  DesignBox box;
  Membership state;
  const Loss* loss = nullptr;  ///< of those outside
};

/// A part of the box that is to be looked at again, with what is decided in it meanwhile.
struct Rest {
  DesignBox box;
  double undecided = 0.0;  ///< volume
  std::vector<Piece> pieces;
};

struct Divided {
  std::vector<Piece> decided;
  std::vector<Rest> rests;
};

/// `range`: of the whole study, by which sides are compared.
Divided divided(const DesignBox& box, std::size_t dimensions, const DesignBox& range, const Knowledge& known);

double volume_of(const DesignBox& box, std::size_t dimensions);
/// Whether a side is longer than this part of the range.
bool is_divisible(const DesignBox& box, std::size_t dimensions, const DesignBox& range, double resolution);

}  // namespace ninedof::admissible
