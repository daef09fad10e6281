#pragma once
/// Poses that check what the corners of cells say: of a low-discrepancy sequence, spread over the cells of level 0 that nothing is
/// proved of.

#include "workspace/cells/octree.hpp"

namespace ninedof {

class Audit {
 public:
  /// Draws the poses and judges them. Throws Stopped.
  void begin(const std::vector<Leaf>& roots, CellLattice& lattice, const Margins& m, const WorkspaceSettings& settings,
             const Control& control);

  long count() const { return static_cast<long>(at_.size()); }
  /// See WorkspaceMap.
  double unseen() const { return unseen_; }

  /// How far a volume is from what the poses say, where that is more than chance (three standard errors); else 0.
  double contradicts(double volume, bool only_if_less) const;

  /// Opens every cell that one of the poses disagrees with.
  Disagreement open(std::vector<Leaf>& leaves) const;

  /// Follows the poses into the children of the cells that are divided; `rank` of a cell among those, -1 for settled ones.
  void descend(const std::vector<Leaf>& leaves, const std::vector<long>& rank, const CellLattice& lattice);

 private:
  std::vector<Vec3> at_;
  std::vector<char> allowed_;
  std::vector<long> cell_;
  double unseen_ = 0.0, volume_ = 0.0, squares_ = 0.0;
};

}  // namespace ninedof
