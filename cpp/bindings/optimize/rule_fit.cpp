#include "ninedof/optimize/rule_fit.hpp"

#include <pybind11/stl.h>

#include "ninedof/proof/bounds.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/placing.hpp"

namespace ninedof::python {
namespace {

/// `known`: shifts of s in zp.
RuleTask task_from(const PosedRobot& machine, const Problem& problem, const std::vector<double>& x, double log_index,
                   const std::vector<RangeEntry>& ranges, const std::vector<std::array<double, 3>>& known) {
  return {machine, problem, Eigen::VectorXd::Map(x.data(), static_cast<Eigen::Index>(x.size())),
          PlacementGoal{log_index, ranges_from(problem, ranges)}, shifts_from(known)};
}

/// `phase`: called with words where the fit is called from.
PointRule fit(const RuleTask& task, int threads, const py::object& phase) {
  require_sound_arithmetic();
  return interruptible(py::none(), [&](const WorkControl& control) {
    const auto say = [&](const std::string& words) { control.on_calling_thread([&] { phase(words); }); };
    return fit_rule(task, {threads, say}, control);
  });
}

}  // namespace

void bind_rule_fit(py::module_& m) {
  py::class_<RuleTask>(m, "RuleTask").def(py::init(&task_from));
  m.def("fit_rule", &fit);
}

}  // namespace ninedof::python
