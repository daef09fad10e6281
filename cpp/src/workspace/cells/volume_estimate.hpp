#pragma once
/// The extrapolated volume of an octree and its error, level by level.

#include <vector>

namespace ninedof {

/// One level, by blocks of the chart.
struct LevelVolumes {
  std::vector<double> held;    ///< allowed volume
  std::vector<double> change;  ///< by dividing the cells of the level before
  double undecided = 0.0;      ///< volume of the cells on the boundary
};

class VolumeEstimate {
 public:
  /// Of the level now reached, after those that are kept.
  void set(const LevelVolumes& level);
  /// Keeps the level: the next one is compared with it.
  void keep();

  double volume() const { return volume_; }
  /// Of resolving the boundary where corners show it. Not of what no corner shows.
  double error() const { return error_; }

 private:
  std::vector<double> better_, before_;  // extrapolated volumes of this level and of that before
  double moved_ = 0.0, moved_before_ = 0.0;
  double volume_ = 0.0, error_ = 0.0;
  int levels_ = 0;
};

}  // namespace ninedof
