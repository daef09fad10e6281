#pragma once
/// What the placing of O has to reach, from the numbers that Python has of it.

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "ninedof/optimize/region_placement.hpp"
#include "support/struct.hpp"

namespace ninedof::python {

/// Lengths of the nine legs in a range: (limit, low, high, size); size 0 for a range of logarithms.
using RangeEntry = std::tuple<std::string, std::array<double, 9>, std::array<double, 9>, double>;

inline std::vector<LegRange> ranges_from(const Problem& problem, const std::vector<RangeEntry>& entries) {
  std::vector<LegRange> out;
  for (const auto& [limit, low, high, size] : entries) {
    LegRange range;
    range.limit = limit;
    range.spread.ratio = !(size > 0.0);
    range.size = range.spread.ratio ? problem.unit() : size;
    const auto measured = [&](double length) { return range.measured(length); };
    range.low = Vec9::Map(low.data()).unaryExpr(measured);
    range.high = Vec9::Map(high.data()).unaryExpr(measured);
    out.push_back(std::move(range));
  }
  return out;
}

/// A design of a problem without poses, and what placing O in a region has to reach for it.
struct PlacedDesign {
  Problem problem;
  Eigen::VectorXd variables;
  double log_index = 0.0;
  std::vector<RangeEntry> ranges;
  std::vector<Vec3> known;  ///< shifts of s in zp

  PlacementGoal goal() const { return {log_index, ranges_from(problem, ranges)}; }
};

}  // namespace ninedof::python
