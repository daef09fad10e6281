#include "ninedof/optimize/optimize.hpp"

#include <pybind11/stl.h>

#include "support/arrays.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

Formulation formulation_from(const std::string& word) {
  if (word == "minimax") return Formulation::minimax;
  if (word == "plain") return Formulation::plain;
  throw InvalidArgument("formulation", "\"" + word + "\"", "\"minimax\" or \"plain\"");
}

}  // namespace

void bind_optimize(py::module_& m) {
  py::dict built_with;
  built_with["nlopt"] = solver_version();
  built_with["eigen"] = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION);
  built_with["compiler"] = __VERSION__;
  m.attr("built_with") = built_with;

  py::class_<Candidate>(m, "Candidate")
      .def_property_readonly("variables", [](const Candidate& c) { return array_from(c.variables); })
      .def_readonly("objective", &Candidate::objective)
      .def_readonly("condition_number", &Candidate::condition_number)
      .def_readonly("conditions", &Candidate::conditions)
      .def_readonly("characteristic_length", &Candidate::characteristic_length)
      .def_readonly("optimality_residual", &Candidate::optimality_residual)
      .def_readonly("constraint_violation", &Candidate::constraint_violation)
      .def_readonly("active", &Candidate::active)
      .def_readonly("prices", &Candidate::prices)
      .def_readonly("reached", &Candidate::reached);
  py::class_<Result>(m, "Result")
      .def_property_readonly("status", [](const Result& r) { return to_string(r.status); })
      .def_readonly("reason", &Result::reason)
      .def_readonly("causes", &Result::causes)
      .def_readonly("candidates", &Result::candidates)
      .def_readonly("evaluations", &Result::evaluations)
      .def_readonly("starts_done", &Result::starts_done)
      .def_readonly("stopped_early", &Result::stopped_early)
      .def_readonly("followed", &Result::followed)
      .def_readonly("interrupted", &Result::interrupted);
  m.def(
      "optimize",
      [](const Problem& problem, int starts, std::uint64_t seed, int threads, int max_evaluations,
         const py::object& progress, const py::object& warm) {
        Settings settings{starts, seed, threads, max_evaluations, {}};
        if (!warm.is_none())
          for (const auto& x : warm.cast<std::vector<std::vector<double>>>())
            settings.warm.emplace_back(Eigen::VectorXd::Map(x.data(), static_cast<Eigen::Index>(x.size())));
        return interruptible(
            progress, [&](const Control& control) { return optimize(problem, settings, control); },
            [](const Result& result) { return result.interrupted; });
      },
      py::arg("problem"), py::arg("starts"), py::arg("seed"), py::arg("threads"), py::arg("max_evaluations"),
      py::arg("progress"), py::arg("warm") = py::none());
  m.def(
      "trace",
      [](const Problem& problem, const std::vector<double>& start, const std::string& formulation) {
        const Trace t = [&] {
          const Formulation f = formulation_from(formulation);
          const py::gil_scoped_release nogil;
          return trace(problem, Eigen::VectorXd::Map(start.data(), static_cast<Eigen::Index>(start.size())), f);
        }();
        return py::make_tuple(t.best, t.end);
      },
      py::arg("problem"), py::arg("start"), py::arg("formulation"));
}

}  // namespace ninedof::python
