#pragma once
/// Distance to the nearest of many points, with a grid of bins.

#include <vector>

#include "ninedof/math/types.hpp"

namespace ninedof {

class NearPoints {
 public:
  NearPoints(const Vec3& low, const Vec3& high, const std::vector<Vec3>& points);
  /// Distance to the nearest point; infinite if there is none.
  double distance(const Vec3& x) const;

 private:
  static constexpr int bins = 32;  // along each side
  std::size_t bin(const int (&at)[3]) const { return at_index((at[2] * bins + at[1]) * bins + at[0]); }
  void place(const Vec3& x, int (&at)[3]) const;

  Vec3 low_, size_;
  std::vector<std::size_t> begin_;
  std::vector<Vec3> points_;
};

}  // namespace ninedof
