#pragma once
/// The search behind a certified workspace.

#include <stop_token>

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

/// Halves boxes until the gap between the bounds of the volume is small enough, or until a stop, which the end of the
/// time gives as well as that of `control`.
void grow(Grown& grown, const LimitsOverBox& cuts, bool some, const CertifySettings& settings,
          const std::stop_token& stop, const Control& control);

/// Whether a box holds allowed poses, as far as so many looks show.
CertifiedWorkspace::Beyond anything_in(const LimitsOverBox& cuts, const PositionBox& box, bool some, long looks,
                                       const std::stop_token& stop);

/// The two halves, across the longest side; none if a double cannot divide it.
std::vector<PositionBox> halves_of(const PositionBox& box);

}  // namespace ninedof::certified
