#pragma once
/// The boundary of a workspace, the indices and cells of its map, and the largest ball and box inside it.

#include "workspace/cells/octree.hpp"

namespace ninedof {

/// Points of the boundary, and its area by limit.
struct Surface {
  std::vector<Vec3> points;
  std::vector<double> area;  ///< by limit; `box` is the part on the faces of the chart
};

/// The boundary of piece 0, or of all pieces.
Surface surface_of(const Octree& tree, CellLattice& lattice, const LimitsAtPoints& margins, bool first_piece_alone,
                   int resolution);

/// Indices, percentiles and cells of a map from leaves.
void summarize(const std::vector<Leaf>& leaves, const CellLattice& lattice, bool first_piece_alone, WorkspaceMap& map,
               const std::stop_token& stop = {});

/// Finds the largest ball and box that contain no point of the surface and stay in the chart, and shrinks both to what
/// is allowed (allowed_scale), or with the best O to whole cells inside.
void inscribe(const std::vector<Leaf>& leaves, const CellLattice& lattice, const LimitsAtPoints& margins,
              const Surface& surface, bool first_piece_alone, const Control& control, WorkspaceMap& map);

/// The largest box with edges along the axes: first one of whole cells (the largest for cells of one size); then its
/// faces are moved to the surface and varied if `vary` is set.
std::optional<InscribedBox> largest_box(const std::vector<Leaf>& leaves, const CellLattice& lattice,
                                        const std::vector<Vec3>& surface, const Chart& chart, bool first_piece_alone,
                                        int resolution, bool vary);

}  // namespace ninedof
