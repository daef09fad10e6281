#pragma once
/// Cells divided where the boundary is, until the volume is known well enough.

#include "workspace/cells/cell_lattice.hpp"

namespace ninedof {

/// A cell that is not divided any further.
struct Leaf {
  Cell cell;
  CellState state = CellState::outside;
  bool proved = false;
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
};

/// Poses known to be allowed, or not, in cells whose corners all say the opposite.
struct Doubt {
  long poses = 0;
  double measure = 0.0;  ///< of those cells
  bool coarse = false;   ///< so many that the cells are too coarse for the set
};

/// What the search knows after its last whole level.
struct Octree {
  WorkspaceStatus status = WorkspaceStatus::stopped;
  std::vector<Leaf> leaves;     ///< settled ones, then the cells of the last level
  std::size_t first_open = 0;   ///< where those begin
  std::vector<WorkspaceLevel> levels;
  long evaluations = 0;
  double unseen = 0.0;       ///< see WorkspaceMap
  Doubt doubt;  ///< of the last level
};

/// Divides until the error is small enough. With `home` the cell of that point is divided as long as it has no allowed corner;
/// with `first_piece_alone` the volume is that of its piece.
Octree grow_octree(const Margins& margins, CellLattice& lattice, const WorkspaceSettings& settings,
                   bool first_piece_alone, const std::optional<Vec3>& home, const Control& control);

/// Connected pieces of the allowed cells, largest first, or that with `home` first; sets Leaf::piece, returns their volumes.
/// Cells are connected where an allowed corner lies on the face they share.
std::vector<double> find_pieces(std::vector<Leaf>& leaves, int resolution, const Chart& chart,
                                const std::optional<Vec3>& home);

}  // namespace ninedof
