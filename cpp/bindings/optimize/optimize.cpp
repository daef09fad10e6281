#include "ninedof/optimize/optimize.hpp"

#include <pybind11/stl.h>

#include <optional>

#include "ninedof/optimize/trace.hpp"
#include "support/arrays.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

using Vectors = std::vector<std::vector<double>>;

Formulation formulation_from(const std::string& word) {
  if (word == "minimax") return Formulation::minimax;
  if (word == "plain") return Formulation::plain;
  throw InvalidArgument("formulation", "\"" + word + "\"", "\"minimax\" or \"plain\"");
}

/// The fields of a Candidate under the names of the Python class, which adds the robot.
py::dict fields_of(const Problem& problem, const Candidate& c) {
  py::dict variables;
  const std::vector<std::string> names = problem.names();
  for (std::size_t k = 0; k < names.size(); ++k)
    variables[py::str(names[k])] = c.variables[static_cast<Eigen::Index>(k)];
  py::dict out;
  out["objective"] = c.objective;
  out["condition_number"] = c.condition_number;
  out["conditions"] = c.conditions;
  out["characteristic_length"] = c.characteristic_length;
  out["variables"] = variables;
  out["active"] = c.active;
  out["prices"] = c.prices;
  out["optimality_residual"] = c.optimality_residual;
  out["constraint_violation"] = c.constraint_violation;
  out["reached"] = c.reached;
  return out;
}

/// The fields of a Result, likewise.
py::dict fields_of(const Problem& problem, const Result& r) {
  py::list candidates;
  for (const Candidate& c : r.candidates) candidates.append(fields_of(problem, c));
  py::dict out;
  out["status"] = to_string(r.status);
  out["reason"] = r.reason;
  out["causes"] = r.causes;
  out["candidates"] = candidates;
  out["evaluations"] = r.evaluations;
  out["starts_done"] = r.starts_done;
  out["runs_abandoned"] = r.runs_abandoned;
  out["runs_completed"] = r.runs_completed;
  out["interrupted"] = r.interrupted;
  return out;
}

}  // namespace

void bind_optimize(py::module_& m) {
  py::dict built_with;
  built_with["nlopt"] = solver_version();
  built_with["eigen"] = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION);
  built_with["compiler"] = __VERSION__;
  m.attr("built_with") = built_with;

  const Settings defaults;
  py::class_<Settings>(m, "Settings")
      .def(py::init([](int starts, std::uint64_t seed, int threads, int max_evaluations,
                       const std::optional<Vectors>& warm) {
             Settings settings{starts, seed, threads, max_evaluations, {}};
             for (const std::vector<double>& x : warm ? *warm : Vectors())
               settings.warm.emplace_back(Eigen::VectorXd::Map(x.data(), static_cast<Eigen::Index>(x.size())));
             return settings;
           }),
           py::kw_only(), py::arg("starts") = defaults.starts, py::arg("seed") = defaults.seed,
           py::arg("threads") = defaults.threads, py::arg("max_evaluations") = defaults.max_evaluations,
           py::arg("warm") = py::none());
  m.def("optimize", [](const Problem& problem, const Settings& settings, const py::object& progress) {
    const Result result = interruptible(
        progress, [&](const Control& control) { return optimize(problem, settings, control); },
        [](const Result& r) { return r.interrupted; });
    return fields_of(problem, result);
  });
  m.def("trace", [](const Problem& problem, const std::vector<double>& start, const std::string& formulation) {
    const Trace t = [&] {
      const Formulation f = formulation_from(formulation);
      const py::gil_scoped_release nogil;
      return trace(problem, Eigen::VectorXd::Map(start.data(), static_cast<Eigen::Index>(start.size())), f);
    }();
    return py::make_tuple(t.best, fields_of(problem, t.end));
  });
}

}  // namespace ninedof::python
