#pragma once
/// The connected pieces of a workspace.

#include "workspace/cells/leaf.hpp"

namespace ninedof {

/// Connected pieces of the allowed cells, largest first, or that with `home` first. Sets Leaf::piece, returns their
/// volumes. Cells are connected if an allowed corner lies on the face they share.
std::vector<double> find_pieces(std::vector<Leaf>& leaves, int resolution, const Chart& chart,
                                const std::optional<Vec3>& home);

}  // namespace ninedof
