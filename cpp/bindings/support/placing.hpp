#pragma once
/// What the placing of O has to reach, from the numbers that Python has of it.

#include <pybind11/stl.h>

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "ninedof/optimize/region_placement.hpp"

namespace ninedof::python {

namespace py = pybind11;

/// Lengths of the nine legs in a range: (limit, low, high, size); size 0 for a range of logarithms.
using RangeEntry = std::tuple<std::string, std::array<double, 9>, std::array<double, 9>, double>;

inline std::vector<LegRange> ranges_from(const Problem& problem, const std::vector<RangeEntry>& entries) {
  std::vector<LegRange> out;
  for (const auto& [limit, low, high, size] : entries) {
    LegRange range;
    range.limit = limit;
    range.logarithm = !(size > 0.0);
    range.size = range.logarithm ? problem.unit() : size;
    const auto measured = [&](double length) { return range.measured(length); };
    range.low = Vec9::Map(low.data()).unaryExpr(measured);
    range.high = Vec9::Map(high.data()).unaryExpr(measured);
    out.push_back(std::move(range));
  }
  return out;
}

/// Shifts of s in zp.
inline std::vector<Vec3> shifts_from(const std::vector<std::array<double, 3>>& rows) {
  std::vector<Vec3> out;
  for (const auto& row : rows) out.push_back(Vec3::Map(row.data()));
  return out;
}

}  // namespace ninedof::python
