#pragma once
/// One cell of the octree, classified and measured by its corners and its centre; and the connected pieces of many.

#include <stop_token>

#include "workspace/cells/cell_lattice.hpp"

namespace ninedof {

/// A cell that is not divided further.
struct Leaf {
  Cell cell;
  CellState state = CellState::outside;
  bool proved = false;            ///< the state follows from bounds of leg lengths and region
  std::uint8_t inside = 0;        ///< which corners are allowed
  std::int16_t limit = -1;
  double fraction = 0.0;          ///< allowed share
  double measure = 0.0;           ///< of the whole cell
  double conditioning = 0.0;      ///< integral of 1 / condition number over the allowed part, by corners and centre
  double conditioning_coarse = 0.0;  ///< the same by the corners alone
  double worst = 0.0;             ///< greatest condition number at an allowed point of the nine
  double condition_number = 0.0;  ///< at the centre
  std::uint32_t worst_point = KeyTable::absent;  ///< of the lattice; absent for the centre
  std::int32_t piece = -1;

  /// Whether it is of the workspace: of piece 0, or of any piece.
  bool counts(bool first_piece_alone) const { return inside != 0 && (!first_piece_alone || piece == 0); }
};

/// The leaf of a cell. Inside or outside if the bounds of legs and region decide, and for each other margin if all nine
/// points agree by more than it may curve between them; else on the boundary.
Leaf leaf_of(const Cell& cell, const NinePoints& points, const CellLattice& lattice, const LimitsAtPoints& margins);

/// Connected pieces of the allowed cells, largest first, or that with `home` first. Sets Leaf::piece, returns their
/// volumes. Cells are connected if an allowed corner lies on the face they share. Nothing is connected with a home that
/// is not allowed, though the cell around it may have allowed corners: the first piece is empty.
/// Throws Stopped.
std::vector<double> find_pieces(std::vector<Leaf>& leaves, int resolution, const Chart& chart,
                                const std::optional<Vec3>& home, bool home_allowed = true,
                                const std::stop_token& stop = {});

}  // namespace ninedof
