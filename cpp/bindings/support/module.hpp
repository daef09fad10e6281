#pragma once
/// One registration function per concept.

#include <pybind11/pybind11.h>

namespace ninedof::python {

namespace py = pybind11;

void bind_geometry(py::module_& m);
void bind_architecture_singularity(py::module_& m);
void bind_kinematics(py::module_& m);
void bind_position(py::module_& m);
void bind_limits(py::module_& m);
void bind_sheet(py::module_& m);
void bind_redundancy(py::module_& m);
void bind_motion(py::module_& m);
void bind_workspace(py::module_& m);
void bind_certified_workspace(py::module_& m);
void bind_workspace_question(py::module_& m);
void bind_workspace_drawing(py::module_& m);
void bind_workspace_statistics(py::module_& m);
void bind_acceleration(py::module_& m);
void bind_conditioning(py::module_& m);
void bind_singularity(py::module_& m);
void bind_statics(py::module_& m);
void bind_dynamics(py::module_& m);
void bind_accuracy(py::module_& m);
void bind_ellipsoid(py::module_& m);
void bind_problem(py::module_& m);
void bind_interval(py::module_& m);
void bind_bounds(py::module_& m);
void bind_machine(py::module_& m);
void bind_condition_search(py::module_& m);
void bind_admissible(py::module_& m);
void bind_optimize(py::module_& m);
void bind_check(py::module_& m);
void bind_rule_fit(py::module_& m);
void bind_optimum(py::module_& m);

}  // namespace ninedof::python
