#pragma once
/// What limits are about, at given poses.

#include <array>
#include <string>
#include <vector>

#include "ninedof/limits/limits.hpp"
#include "ninedof/limits/spread_row.hpp"
#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

struct PoseRow;

/// The limits that have a value at every pose, in the order of their table.
std::vector<std::string> limits_of_poses();

/// Those of the longest and shortest lengths of legs over all poses together.
std::vector<std::string> limits_over_lengths();

/// The row of one of these; throws InvalidArgument for another name.
const SpreadRow& spread_row(const std::string& name);

/// The items of a limit at poses, or over lengths: legs ("l1"), pairs of legs ("l1-q2"), determinants ("det N"); none
/// where it is of all legs together.
std::vector<std::string> limit_parts(const std::string& name);

/// The body of the joints whose angles a limit is about, "base" or "platform"; "" for other limits.
std::string limit_body(const std::string& name);

/// The numbers that a limit at poses is about, an item each: lengths, angles in radians, distances of legs,
/// determinants, positive on the side of the neutral pose, condition numbers with a leg locked, or forces, rates and
/// powers of legs.
class LimitNumbers {
 public:
  /// Pairs of legs that are `exempt` have an infinite distance.
  LimitNumbers(const std::string& name, const Geometry& g, const Configuration& home, double characteristic_length,
               const LimitOptions& options = {}, const std::array<bool, 21>& exempt = {});
  int items() const;
  /// `out` has room for them.
  void at(const Configuration& pose, double* out) const;

 private:
  const PoseRow& row_;
  Geometry geometry_;
  PosedPoints home_;
  LimitOptions options_;
  std::array<bool, 21> exempt_;
  double length_;
};

/// Every pair of legs.
inline constexpr std::array<bool, 21> all_pairs = [] {
  std::array<bool, 21> out{};
  out.fill(true);
  return out;
}();

/// The pairs of legs, of those in `among`, whose joints coincide in this robot.
std::array<bool, 21> pairs_sharing_a_joint(const Geometry& g, const std::array<bool, 21>& among = all_pairs);

}  // namespace ninedof
