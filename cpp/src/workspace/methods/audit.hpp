#pragma once
/// Poses that check cells: a low-discrepancy sequence over the cells of level 0 that are not proved.

#include "workspace/cells/octree.hpp"

namespace ninedof {

class Audit {
 public:
  /// Draws and evaluates the poses. Throws Stopped.
  void begin(const std::vector<Leaf>& roots, CellLattice& lattice, const Margins& m, const WorkspaceSettings& settings,
             const Control& control);

  long count() const { return static_cast<long>(at_.size()); }
  /// See WorkspaceMap.
  double unseen() const { return unseen_; }

  /// The difference between a volume and the estimate of the poses if it exceeds three standard errors; else 0.
  double contradicts(double volume, bool only_if_less) const;

  /// Marks every cell that one of the poses contradicts as boundary.
  Disagreement open(std::vector<Leaf>& leaves) const;

  /// Assigns poses to the children of divided cells; `rank` numbers the divided ones, -1 for settled ones.
  void descend(const std::vector<Leaf>& leaves, const std::vector<long>& rank, const CellLattice& lattice);

 private:
  std::vector<Vec3> at_;
  std::vector<char> allowed_;
  std::vector<long> cell_;
  double unseen_ = 0.0, volume_ = 0.0, squares_ = 0.0;
};

}  // namespace ninedof
