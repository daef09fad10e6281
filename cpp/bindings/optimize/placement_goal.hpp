#pragma once
/// What the placing of O has to reach, from Python.

#include <pybind11/stl.h>

#include "ninedof/optimize/region_placement.hpp"

namespace ninedof::python {

namespace py = pybind11;

/// `ranges`: (limit, low, high, size) of the lengths of the nine legs; size 0 for a range of logarithms.
inline PlacementGoal goal_from(const Problem& problem, double log_index, const py::sequence& ranges) {
  PlacementGoal goal{log_index, {}};
  for (const py::handle& range : ranges) {
    const auto [limit, low, high, size] =
        range.cast<std::tuple<std::string, std::array<double, 9>, std::array<double, 9>, double>>();
    LegRange r{limit, Vec9::Map(low.data()), Vec9::Map(high.data()), size > 0.0 ? size : problem.unit(), !(size > 0.0)};
    for (Vec9* end : {&r.low, &r.high}) *end = end->unaryExpr([&r](double length) { return r.measured(length); });
    goal.ranges.push_back(std::move(r));
  }
  return goal;
}

}  // namespace ninedof::python
