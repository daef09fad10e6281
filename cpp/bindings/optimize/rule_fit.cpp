#include "ninedof/optimize/rule_fit.hpp"

#include "ninedof/proof/bounds.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/placing.hpp"

namespace ninedof::python {

void bind_rule_fit(py::module_& m) {
  // `phase`: called with words where the fit is called from.
  m.def("fit_rule", [](const PosedRobot& machine, const PlacedDesign& design, int threads, const py::object& phase) {
    require_sound_arithmetic();
    const RuleTask task{machine, design.problem, design.variables, design.goal(), design.known};
    return interruptible(py::none(), [&](const WorkControl& control) {
      const auto say = [&](const std::string& words) { control.on_calling_thread([&] { phase(words); }); };
      return fit_rule(task, {threads, say}, control);
    });
  });
}

}  // namespace ninedof::python
