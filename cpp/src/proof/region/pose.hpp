#pragma once
/// Boxes of poses, and a pose as forms over a box.
///
/// A domain is a list of pieces: the region, the straight parts of a path, or one listed pose. A pose of a piece has
/// the six coordinates of Region (on a path the first goes from 0 to 1 along one part). Discs and balls are boxes with
/// corners cut off: boxes wholly outside are left out, and linear functions are bounded over the disc as well.

#include <array>
#include <vector>

#include "ninedof/proof/machine.hpp"
#include "proof/region/rule.hpp"
#include "robot/pose_of.hpp"

namespace ninedof::over_region {

struct Box {
  int piece = 0;
  std::array<double, PoseForm::size> low{}, high{};
  auto operator<=>(const Box&) const = default;
};

/// Coordinates whose vector has at most a given length.
struct Disc {
  std::size_t first, count;
  double radius;
};

/// All poses of a machine.
class Domain {
 public:
  explicit Domain(const PosedRobot& machine);
  const PosedRobot& machine() const { return machine_; }
  /// Every machine within tolerances.
  const AsBuilt& built() const { return built_; }
  const std::vector<Box>& roots() const { return roots_; }
  template <class T = PoseForm>
  PoseOf<T> pose(const Box& box) const;
  /// A pose of the region from a neutral one; `unit` is that of positions: 1 or zp.
  template <class T, class Unit>
  PoseOf<T> moved(const Box& box, const PoseOf<T>& neutral, const Unit& unit) const;
  MetAt met(const Box& point) const;
  /// A box of one pose in doubles.
  Configuration configuration(const Box& point) const;
  /// The pose at coordinates of the region, as a box of one point.
  Box point(const Vec6& at) const;
  /// Whether no point of the box is a pose of the domain.
  bool outside(const Box& box) const;
  /// The nearest pose of the domain to a point.
  Box nearest(Box point) const;
  /// At least the values of a form at the poses of the domain in a box.
  double greatest(const PoseForm& f, const Box& box) const;
  /// A pose where it is large, in the box or near it.
  Box towards(const std::array<double, PoseForm::size>& slope, const Box& box) const;

 private:
  bool cut(const Box& box) const { return box.piece >= 0 && !discs_.empty(); }

  const PosedRobot& machine_;
  AsBuilt built_;
  std::vector<Box> roots_;
  std::vector<RuleForms> rule_;  // none or one
  std::vector<Disc> discs_;
};

/// The coordinate that moves something most within the box; -1 where a box cannot be divided.
int divided_coordinate(const Box& box, const std::array<double, PoseForm::size>& moves);
/// The two halves of a box.
std::array<Box, 2> halves(const Box& box, int coordinate);
/// The middle, or a corner, of a box, as a box of one point; `side` has the signs of the corner.
Box middle_of(const Box& box);
Box corner_of(const Box& box, const std::array<double, PoseForm::size>& side);

}  // namespace ninedof::over_region
