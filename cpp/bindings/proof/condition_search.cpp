#include "ninedof/proof/condition_search.hpp"

#include <pybind11/stl.h>

#include "ninedof/proof/bounds.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

/// `keep`, None or a callable, is called with a state where the search is called from.
ConditionState search(const PosedRobot& machine, const ConditionSettings& settings, const ConditionState& earlier,
                      const py::object& keep, const py::object& progress) {
  require_sound_arithmetic();
  return interruptible(
      progress,
      [&](const WorkControl& control) {
        std::function<void(const ConditionState&)> kept;
        if (!keep.is_none())
          kept = [&](const ConditionState& state) { control.on_calling_thread([&] { keep(state); }); };
        return search_condition(machine, settings, earlier, kept, control);
      },
      [](ConditionState& state) { return state.interrupted = true; });
}

}  // namespace

void bind_condition_search(py::module_& m) {
  const ConditionSettings defaults;
  py::class_<ConditionSettings>(m, "ConditionSettings", "When the search for the worst condition number ends.")
      .def(py::init([](int threads, double seconds, double gap, const std::vector<double>& wanted, double tolerance,
                       double slice_seconds, double least_seconds, double keep_share) {
             return ConditionSettings{threads,   seconds,       gap,           wanted,
                                      tolerance, slice_seconds, least_seconds, keep_share};
           }),
           py::kw_only(), py::arg("threads"), py::arg("seconds"), py::arg("gap"), py::arg("wanted"),
           py::arg("tolerance"), py::arg("slice_seconds") = defaults.slice_seconds,
           py::arg("least_seconds") = defaults.least_seconds, py::arg("keep_share") = defaults.keep_share);
  py::class_<ConditionState>(m, "ConditionState",
                             "What is proved of the worst condition number, and what is left to look at.")
      .def(py::init<>())
      .def_readwrite("low", &ConditionState::low, "A condition number that was met; 0 before any.")
      .def_readwrite("high", &ConditionState::high, "A proved upper bound.")
      .def_readwrite("at", &ConditionState::at, "Where `low` was met.")
      .def_readwrite("boxes", &ConditionState::boxes, "Looked at.")
      .def_readwrite("left", &ConditionState::left, "Boxes to go on with; none where they are too many.")
      .def_readonly("left_count", &ConditionState::left_count, "The number of them.")
      .def_readwrite("target", &ConditionState::target, "The bound that was tried last.")
      .def_readwrite("interrupted", &ConditionState::interrupted, "By Ctrl-C.");
  m.def("search_condition", &search);
}

}  // namespace ninedof::python
