#pragma once
/// Whether a box of designs holds one that keeps the limits with a condition number below a target.

#include "proof/nonplanar/line_design.hpp"
#include "proof/optimum/proof_tree.hpp"

namespace ninedof::proof {

struct LineVerdict {
  bool empty = false;
  double at_middle = infinity;  ///< else the condition number of the design in the middle, if it keeps the limits
  std::size_t cut = 0;          ///< where to cut the box
  bool divisible = true;
  Bytes reasons;  ///< what made the box smaller and, where it is empty, closed it: for a certificate
};

/// Makes the box smaller where no design is lost. `keep` asks for the reasons.
LineVerdict test_box(LineBox& box, const LineLimits& limits, const SidesOfO& sides, double target, bool keep = false);

/// Where a box is cut.
double cut_at(const LineBox& box, std::size_t coordinate);

}  // namespace ninedof::proof
