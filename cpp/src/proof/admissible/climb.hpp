#pragma once
/// An item over all its poses as planes over a box of designs: a branch and bound whose bounds are linear in the
/// design.

#include <stop_token>
#include <vector>

#include "proof/admissible/items.hpp"

namespace ninedof::admissible {

/// All designs of the box where the plane is negative break the demand at a pose.
struct Loss {
  Plane most;
  int demand = 0;
  Box at;
  /// Of a spread: the legs, and where the second is shortest.
  int longest = -1, shortest = -1;
  Box other = {};
};

struct Found {
  enum class Status {
    kept,     ///< by all designs of the box
    cut,      ///< by those where all `cuts` are positive
    outside,  ///< by none: the last loss
    unknown   ///< not known of any; losses hold all the same
  } status = Status::kept;
  std::vector<Plane> cuts;
  std::vector<Loss> losses;
  std::vector<Box> open;  ///< of a condition number: the boxes outside of which all designs keep it
  long boxes = 0;
};

/// On a stop it ends with what is known. `width`: of the box of designs, as a part of all: large boxes are hardly ever
/// proved, and searched for less long. `may_be_inside`: of the other items nothing is unknown.
Found climb(const DesignsAt& designs, const Item& item, const std::vector<Box>& roots, double width, bool may_be_inside,
            const std::stop_token& stop);

/// Planes none of whose least is above the length, or less the length, and the poses that they were found at.
struct Envelope {
  bool known = false;
  std::vector<Plane> least;
  std::vector<Met> met;
  std::vector<Box> at;
  long boxes = 0;
};
/// `allowed`: planes may be off by so much.
Envelope envelope(const DesignsAt& designs, const Length& length, const std::vector<Box>& roots, double allowed,
                  const std::stop_token& stop);

}  // namespace ninedof::admissible
