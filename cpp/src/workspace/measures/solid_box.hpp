#pragma once
/// The largest box with edges along the axes in a set of cells.

#include "workspace/cells/octree.hpp"

namespace ninedof {

/// First of whole cells (exact for those of one size), then each face is moved to the surface and traded against the others.
std::optional<InscribedBox> largest_box(const std::vector<Leaf>& leaves, const CellLattice& lattice,
                                        const std::vector<Vec3>& surface, const Chart& chart, bool first_piece_alone,
                                        int resolution);

}  // namespace ninedof
