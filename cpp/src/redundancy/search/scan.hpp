#pragma once
/// A scan of the chamber: the criterion on cells that are divided where it may be lower than the best known value.

#include <array>
#include <functional>
#include <vector>

#include "math/numbers.hpp"
#include "redundancy/search/pose_objective.hpp"

namespace ninedof {

/// A cell of the scan, and the point of it that stands for all.
struct ScanCell {
  std::array<int, 3> place;  ///< in cells of its level
  Vec3 x;                    ///< the middle, moved into the limits where they cut the cell
  double broken;             ///< PoseObjective::violation of x
  double value = infinity;   ///< of PoseObjective::exact at x; infinite in another chamber
  double drop = infinity;  ///< how much lower the criterion may be elsewhere in the cell: the spread of the values of
  ///< the cell that was divided and of its parts

  /// Whether the cell may hold a value below `best`.
  bool may_hold(double best) const { return !(value - drop >= best); }
};

/// The box that the upper limits allow, or the surroundings of the robot, in equal cells. Those that the limits exclude
/// are left out. Points of another chamber may have the same signs of the determinants: see Reach.
class Scan {
 public:
  /// Begins with (n / 2)^3 cells without limits, with limits with an eighth of that at least. The first division keeps
  /// them all.
  Scan(const PoseObjective& objective, int n);

  const std::vector<ScanCell>& cells() const { return cells_; }
  /// The diagonal of a cell.
  double diagonal() const { return edge().norm(); }
  /// Whether every cell that could hold a lower value was divided.
  bool complete() const { return complete_; }

  /// Keeps the cells that may hold a value below `best` and whose points `reached` accepts.
  void keep(double best, const std::function<bool(const Vec3&)>& reached);

  /// Divides the cells that may hold a value below `best`; the others are left out.
  void divide(double best);

  /// Cells that may hold a value below `best`, no worse than those around them; lowest first.
  std::vector<ScanCell> valleys(double best) const;

 private:
  Vec3 edge() const { return (high_ - low_) / parts_; }
  Vec3 middle(const std::array<int, 3>& place) const {
    return low_ + (Vec3(place[0], place[1], place[2]).array() + 0.5).matrix().cwiseProduct(edge());
  }
  /// Adds the parts of a cell that the limits do not exclude, of the chamber or all.
  void add_parts(const std::array<int, 3>& place, bool of_chamber, std::vector<ScanCell>& out) const;
  void evaluate(std::vector<ScanCell>& cells) const;

  const PoseObjective& objective_;
  Vec3 low_, high_;
  int parts_;  // of the box along each axis
  std::vector<ScanCell> cells_;
  bool complete_ = true;
};

}  // namespace ninedof
