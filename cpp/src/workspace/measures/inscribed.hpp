#pragma once
/// The largest ball and the largest box inside a workspace.

#include "workspace/measures/summary.hpp"

namespace ninedof {

/// Finds the largest ball and box that contain no point of the surface and stay in the chart, and shrinks both until a
/// few hundred points of their own surfaces are allowed.
void inscribe(const std::vector<Leaf>& leaves, const CellLattice& lattice, const Margins& margins,
              const Surface& surface, bool first_piece_alone, const Control& control, WorkspaceMap& map);

}  // namespace ninedof
