#pragma once
/// The boundary of a workspace, and the indices and cells of its map.

#include "workspace/cells/octree.hpp"

namespace ninedof {

/// Points of the boundary, and its area by limit.
struct Surface {
  std::vector<Vec3> points;
  std::vector<double> area;  ///< by limit; `box` is the part on the faces of the chart
};

/// The boundary of piece 0, or of all pieces.
Surface surface_of(const Octree& tree, CellLattice& lattice, const Margins& margins, bool first_piece_alone,
                   int resolution);

/// Indices, percentiles and cells of a map from leaves.
void summarize(const std::vector<Leaf>& leaves, const CellLattice& lattice, bool first_piece_alone, WorkspaceMap& map);

}  // namespace ninedof
