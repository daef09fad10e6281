#include "ninedof/optimize/check.hpp"

#include <pybind11/stl.h>

#include "support/arrays.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

OptimumCheck optimum_checked(const Problem& problem, const std::vector<double>& x, long steps, std::uint64_t seed) {
  return interruptible(py::none(), [&](const Control& control) {
    return check_optimum(problem, vector_from(x), {steps, seed}, control);
  });
}

RegionCheck region_checked(const Problem& problem, const Region& region, const std::vector<double>& x,
                           const std::optional<LegLimits>& lengths, std::uint64_t seed) {
  return interruptible(py::none(), [&](const Control& control) {
    return check_region(problem, region, vector_from(x), lengths, seed, control);
  });
}

}  // namespace

void bind_check(py::module_& m) {
  py::class_<OptimumCheck>(m, "OptimumCheck", "Whether a design is an optimum: the first-order test and random steps.")
      .def_readonly("residual", &OptimumCheck::residual, "Of the first-order conditions; 0 at a stationary point.")
      .def_readonly("active", &OptimumCheck::active, "Bounds and limits that are reached.")
      .def_readonly("steps", &OptimumCheck::steps, "Random steps; 0 where no variable is free.")
      .def_readonly("better", &OptimumCheck::better, "Of them, those to a smaller objective, allowed or not.")
      .def_readonly("gain", &OptimumCheck::gain, "Largest relative improvement by an allowed design; 0 for none.");
  py::class_<RegionCheck>(m, "RegionCheck", "Where a design is worst over a region.")
      .def_readonly("index", &RegionCheck::index, "The greatest value of the index.")
      .def_readonly("margin", &RegionCheck::margin, "The least of a limit, relative; infinite without limits.")
      .def_readonly("excess", &RegionCheck::excess,
                    "By how much a limit or the index is passed, in logarithms; negative where none is.")
      .def_readonly("poses", &RegionCheck::poses, "Looked at.")
      .def_property_readonly(
          "mean",
          [](const RegionCheck& c) { return c.mean ? c.mean->value : std::numeric_limits<double>::quiet_NaN(); },
          "Of the index, NaN where the objective is no mean.")
      .def_property_readonly(
          "standard_error",
          [](const RegionCheck& c) {
            return c.mean ? c.mean->standard_error : std::numeric_limits<double>::quiet_NaN();
          },
          "Of the mean.");
  m.def("check_optimum", &optimum_checked);
  m.def("check_region", &region_checked);
}

}  // namespace ninedof::python
