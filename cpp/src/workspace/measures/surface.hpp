#pragma once
/// The boundary of what was found: points on it, and which limit has how much of it.

#include "workspace/cells/octree.hpp"

namespace ninedof {

struct Surface {
  std::vector<Vec3> points;
  std::vector<double> area;  ///< by limit; that of `box` is where the workspace runs to the chart's own faces
};

/// Of the leaves of piece 0, or of every piece.
Surface surface_of(const Octree& tree, CellLattice& lattice, const Margins& margins, bool first_piece_alone,
                   int resolution);

/// Indices, percentiles and cells of a map from leaves.
void summarize(const std::vector<Leaf>& leaves, const CellLattice& lattice, bool first_piece_alone, WorkspaceMap& map);

/// The largest ball and box that hold no point of the surface and stay in the chart. Then both are shrunk until a few hundred
/// points of their own surfaces are allowed.
void inscribe(const std::vector<Leaf>& leaves, const CellLattice& lattice, const Margins& margins,
              const Surface& surface, bool first_piece_alone, const Control& control, WorkspaceMap& map);

/// The other two methods.
void map_by_grid(const Margins& margins, const WorkspaceSettings& settings, bool first_piece_alone,
                 const Control& control, WorkspaceMap& map);
void map_by_sample(const Margins& margins, const WorkspaceSettings& settings, const Control& control,
                   WorkspaceMap& map);

}  // namespace ninedof
