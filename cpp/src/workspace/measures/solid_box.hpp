#pragma once
/// The largest box with edges along the axes in a set of cells.

#include "workspace/cells/octree.hpp"

namespace ninedof {

/// First a box of whole cells (the largest for cells of one size); then its faces are moved to the surface and varied.
std::optional<InscribedBox> largest_box(const std::vector<Leaf>& leaves, const CellLattice& lattice,
                                        const std::vector<Vec3>& surface, const Chart& chart, bool first_piece_alone,
                                        int resolution);

}  // namespace ninedof
