#pragma once
/// Poses that check cells: low-discrepancy sequences over the cells that are not proved.

#include "workspace/cells/octree.hpp"

namespace ninedof {

class Audit {
 public:
  Audit(CellLattice& lattice, const LimitsAtPoints& m, const WorkspaceSettings& settings, const Control& control)
      : lattice_(lattice), m_(m), settings_(settings), control_(control) {}

  /// Draws and evaluates the poses. Throws Stopped.
  void begin(const std::vector<Leaf>& roots);
  /// Draws `count` more in all leaves that are not proved: settled ones, and those of the last level. A settled leaf
  /// that one of them contradicts moves to the end of the last level. Throws Stopped.
  void extend(std::vector<Leaf>& settled, std::vector<Leaf>& now, long count);

  long count() const { return static_cast<long>(at_.size()); }
  /// Upper bound, at about 95 % confidence, of the volume of a feature that `hits` of the poses met.
  double bound(long hits) const;
  /// How many more poses in cells of the volume `where` make bound(hits) at most `wanted`.
  double more(long hits, double where, double wanted) const;

  /// The difference between a volume and the estimate of the first poses if it exceeds three standard errors; else 0.
  double contradicts(double volume, bool only_if_less) const;

  /// Marks every cell that one of the poses contradicts as boundary.
  Disagreement open(std::vector<Leaf>& leaves) const;

  /// Assigns poses to the children of divided cells; `rank` numbers the divided ones, -1 for settled ones.
  void descend(const std::vector<Leaf>& leaves, const std::vector<long>& rank);

 private:
  /// `count` poses spread over leaves; `number` is what they remember of each.
  void draw(const std::vector<const Leaf*>& leaves, const std::vector<long>& number, long count);
  double volume_of(const Leaf& leaf) const { return lattice_.size(leaf.cell.level).prod(); }

  CellLattice& lattice_;
  const LimitsAtPoints& m_;
  const WorkspaceSettings& settings_;
  const Control& control_;
  std::vector<Vec3> at_;
  std::vector<char> allowed_;
  std::vector<long> cell_;
  std::uint64_t batches_ = 0;
  double density_ = 0.0;  // poses per unit of volume
  double volume_ = 0.0, squares_ = 0.0, first_ = 0.0;  // estimate of the first ones, and their bound(0)
};

}  // namespace ninedof
