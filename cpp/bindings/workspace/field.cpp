#include "ninedof/workspace/field.hpp"

#include <pybind11/stl.h>

#include "support/cell_map.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/raster.hpp"

namespace ninedof::python {
namespace {

using Ends = std::pair<Array, Array>;

/// A WorkspaceField.
WorkspaceField field_from(const py::object& field) {
  const Axes axes = field.attr("axes").cast<Axes>();
  return {raster_from(axes, field.attr("fraction").cast<Array>()),
          raster_from(axes, field.attr("condition_number").cast<Array>())};
}

/// Horizontal and vertical places, then state, limit, condition number and share: the last fields of a WorkspaceSlice.
py::tuple tuple_of(const WorkspaceSection& s) {
  const std::vector<py::ssize_t> shape{std::ssize(s.vertical), std::ssize(s.horizontal)};
  return py::make_tuple(column<double>(s.horizontal), column<double>(s.vertical), column<std::uint8_t>(s.state, shape),
                        column<std::int16_t>(s.limit, shape), column<double>(s.condition_number, shape),
                        column<double>(s.fraction, shape));
}

}  // namespace

void bind_workspace_field(py::module_& m) {
  m.def("workspace_field", [](const py::object& cells, const Ends& ends, long most) {
    const WorkspaceMap map = map_from(cells, ends);
    const WorkspaceField field =
        interruptible(py::none(), [&](const Control& control) { return field_of(map, most, control.stop); });
    return py::make_tuple(axes_of(field.fraction), values_of(field.fraction), values_of(field.condition_number));
  });
  m.def("workspace_surface", [](const py::object& field) {
    const WorkspaceField all = field_from(field);
    return points_and_faces(interruptible(py::none(), [&](const Control&) { return surface_of(all); }));
  });
  m.def("cell_section", [](const py::object& cells, const Ends& ends, int fixed, double at, int pixels) {
    const WorkspaceMap map = map_from(cells, ends);
    return tuple_of(interruptible(
        py::none(), [&](const Control& control) { return section_of(map, fixed, at, pixels, control.stop); }));
  });
  m.def("field_section", [](const py::object& cells, const Ends& ends, const py::object& field, int fixed, double at) {
    const WorkspaceMap map = map_from(cells, ends);
    const WorkspaceField all = field_from(field);
    return tuple_of(interruptible(
        py::none(), [&](const Control& control) { return section_of(map, all, fixed, at, control.stop); }));
  });
}

}  // namespace ninedof::python
