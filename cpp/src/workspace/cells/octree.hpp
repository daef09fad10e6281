#pragma once
/// An octree divided at the boundary of the workspace until the volume has the wanted accuracy.

#include "workspace/cells/leaf.hpp"

namespace ninedof {

/// Audit poses that are allowed, or not, in cells whose corners all say the opposite.
struct Disagreement {
  long poses = 0;
  bool coarse = false;   ///< so many that the cells are too coarse
};

/// The state after the last complete level.
struct Octree {
  WorkspaceStatus status = WorkspaceStatus::stopped;
  std::vector<Leaf> leaves;     ///< settled ones, then the cells of the last level
  std::size_t first_open = 0;   ///< index of the first cell of the last level
  std::vector<WorkspaceLevel> levels;
  long evaluations = 0;
  double unseen = 0.0;       ///< see WorkspaceMap
  Disagreement disagreement;  ///< of the last level
};

/// Divides until the error is small enough. The cell of an allowed home pose is divided as long as it has no allowed
/// corner; with `first_piece_alone` the volume is that of its piece.
Octree grow_octree(const LimitsAtPoints& margins, CellLattice& lattice, const WorkspaceSettings& settings,
                   bool first_piece_alone, bool home_allowed, const Control& control);

}  // namespace ninedof
