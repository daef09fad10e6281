#pragma once
/// The search behind a certified workspace.

#include <functional>

#include "ninedof/math/control.hpp"
#include "workspace/certified/box_tree.hpp"

namespace ninedof::certified {

struct Grown {
  Tree tree;
  CertifiedWorkspace::End end = CertifiedWorkspace::End::gap;
  long looked = 0;
};

/// The box as it is.
Grown seed(const LimitsOverBox& cuts, const PositionBox& box, bool some);

/// Halves boxes until the gap between the bounds of the volume is small enough.
void grow(Grown& grown, const LimitsOverBox& cuts, bool some, const CertifySettings& settings,
          const std::function<bool()>& time_is_over, const Control& control);

/// Whether a box holds allowed poses, as far as so many looks show before `over`.
CertifiedWorkspace::Beyond anything_in(const LimitsOverBox& cuts, const PositionBox& box, bool some, long looks,
                                       const std::function<bool()>& over);

/// The two halves, across the longest side; none if a double cannot divide it.
std::vector<PositionBox> halves_of(const PositionBox& box);

}  // namespace ninedof::certified
