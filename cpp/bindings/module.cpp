/// The table of contents of ninedof._core. Public names are chosen in Python.

#include "support/module.hpp"

#include "support/without_gil.hpp"

// A module of another name than the one that Python imports: its entry is called by ours, below.
PYBIND11_MODULE(ninedof_core, m, pybind11::mod_gil_not_used()) {
  m.doc() = "The compiled core of ninedof. Private: use the names of `ninedof`.";
  m.attr("version") = NINEDOF_VERSION;
  ninedof::python::watch_interpreter_exit();
  ninedof::python::bind_geometry(m);
  ninedof::python::bind_architecture_singularity(m);
  ninedof::python::bind_kinematics(m);
  ninedof::python::bind_position(m);
  ninedof::python::bind_limits(m);
  ninedof::python::bind_redundancy(m);
  ninedof::python::bind_motion(m);
  ninedof::python::bind_workspace_question(m);
  ninedof::python::bind_workspace(m);
  ninedof::python::bind_certified_workspace(m);
  ninedof::python::bind_workspace_drawing(m);
  ninedof::python::bind_workspace_statistics(m);
  ninedof::python::bind_acceleration(m);
  ninedof::python::bind_conditioning(m);
  ninedof::python::bind_singularity(m);
  ninedof::python::bind_statics(m);
  ninedof::python::bind_dynamics(m);
  ninedof::python::bind_accuracy(m);
  ninedof::python::bind_ellipsoid(m);
  ninedof::python::bind_problem(m);
  ninedof::python::bind_interval(m);
  ninedof::python::bind_bounds(m);
  ninedof::python::bind_machine(m);
  ninedof::python::bind_condition_search(m);
  ninedof::python::bind_admissible(m);
  ninedof::python::bind_optimize(m);
  ninedof::python::bind_check(m);
  ninedof::python::bind_sheet(m);
  ninedof::python::bind_rule_fit(m);
  ninedof::python::bind_optimum(m);
}

/// In a subinterpreter pybind11 would wait for ever for the GIL of the main one, in its first step: refused before.
extern "C" PYBIND11_EXPORT PyObject* PyInit__core() {
  if (PyInterpreterState_Get() == PyInterpreterState_Main()) return PyInit_ninedof_core();
  PyErr_SetString(PyExc_ImportError, "ninedof: got a subinterpreter, expected the main interpreter of the process");
  return nullptr;
}
