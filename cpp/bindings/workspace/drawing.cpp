/// Rasters, sections and surfaces of a workspace, for drawing.

#include "ninedof/workspace/field.hpp"
#include "support/cell_map.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

using Axes = std::array<Array, 3>;

Raster raster_from(const Axes& axes, const Array& values) {
  Raster out;
  bool fits = values.ndim() == 3;
  for (py::ssize_t k = 0; k < 3; ++k) {
    const Array& axis = axes[at_index(k)];
    fits = fits && axis.ndim() == 1 && axis.size() >= 2 && values.shape(k) == axis.size();
    if (!fits)
      throw InvalidArgument("field", "axes and values that do not match", "shapes (n,) and (n_x, n_y, n_z), n >= 2");
    out.count[at_index(k)] = at_index(axis.size());
    out.first[k] = axis.data()[0];
    out.step[k] = axis.data()[1] - axis.data()[0];
  }
  out.values.assign(values.data(), values.data() + values.size());
  return out;
}

auto values_of(Raster WorkspaceField::* raster) {
  return [raster](const WorkspaceField& field) {
    std::vector<py::ssize_t> shape;
    for (const std::size_t count : (field.*raster).count) shape.push_back(static_cast<py::ssize_t>(count));
    return column<double>((field.*raster).values, shape);
  };
}

py::tuple axes_of(const WorkspaceField& field) {
  const Raster& raster = field.fraction;
  py::tuple out(3);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    std::vector<double> places;
    for (std::size_t n = 0; n < raster.count[k]; ++n)
      places.push_back(raster.first[axis] + raster.step[axis] * static_cast<double>(n));
    out[k] = column<double>(places);
  }
  return out;
}

/// A getter of numbers of a section as an array (vertical, horizontal).
template <class Number, class U>
auto rows_of(std::vector<U> WorkspaceSection::* member) {
  return [member](const WorkspaceSection& s) {
    return column<Number>(s.*member, {std::ssize(s.vertical), std::ssize(s.horizontal)});
  };
}

py::array_t<std::int64_t> faces_of(const QuadSurface& surface) {
  py::array_t<std::int64_t> faces(std::vector<py::ssize_t>{std::ssize(surface.faces), 4});
  std::int64_t* to = faces.mutable_data();
  for (const QuadSurface::Face& face : surface.faces) to = std::ranges::copy(face, to).out;
  return faces;
}

std::string words_of(const QuadSurface& surface) {
  return "<WorkspaceSurface: " + std::to_string(surface.points.size()) + " points, " +
         std::to_string(surface.faces.size()) + " faces>";
}

}  // namespace

void bind_workspace_drawing(py::module_& m) {
  py::class_<QuadSurface>(m, "WorkspaceSurface",
                          "A closed surface; seen from outside the corners of a face run counterclockwise.")
      .def_property_readonly("points", points_of(&QuadSurface::points), "Shape (n, 3), in the coordinates of the map.")
      .def_property_readonly("faces", &faces_of, "Rows of four numbers of points, shape (m, 4).")
      .def_property_readonly(
          "normals", [](const QuadSurface& s) { return array_from(surface_normals(s)); },
          "Outward unit normals of the faces, shape (m, 3).")
      .def_property_readonly("volume", &enclosed_volume, "Volume enclosed, by the divergence theorem.")
      .def("__repr__", &words_of);
  py::class_<WorkspaceField>(
      m, "WorkspaceField",
      "Allowed share and condition number on an even raster about the workspace; arrays of shape "
      "(n_x, n_y, n_z).")
      .def(py::init([](const Axes& axes, const Array& fraction, const Array& condition_number) {
             return WorkspaceField{raster_from(axes, fraction), raster_from(axes, condition_number)};
           }),
           py::arg("axes"), py::arg("fraction"), py::arg("condition_number"))
      .def_property_readonly("axes", &axes_of, "Positions of the raster along each coordinate.")
      .def_property_readonly("fraction", values_of(&WorkspaceField::fraction),
                             "Allowed share, smoothed over neighbours: the workspace ends where it is one half; 0 in "
                             "the outermost layer.")
      .def_property_readonly("condition_number", values_of(&WorkspaceField::condition_number),
                             "Interpolated between the centres of cells, outside the workspace too.")
      .def(
          "surface",
          [](const WorkspaceField& f) {
            return interruptible(py::none(), [&](const Control&) { return surface_of(f); });
          },
          "Return the surface at the level of the allowed share that keeps the volume.")
      .def("__repr__", [](const WorkspaceField& f) {
        const auto& n = f.fraction.count;
        return "<WorkspaceField of " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
               std::to_string(n[2]) + " points>";
      });
  py::class_<WorkspaceSection>(m, "WorkspaceSection", "A plane section; rows lie along the vertical.")
      .def_property_readonly("horizontal", column_of<double>(&WorkspaceSection::horizontal),
                             "Coordinates of the columns, shape (n,).")
      .def_property_readonly("vertical", column_of<double>(&WorkspaceSection::vertical),
                             "Coordinates of the rows, shape (m,).")
      .def_property_readonly("state", rows_of<std::uint8_t>(&WorkspaceSection::state),
                             "0 outside, 1 boundary, 2 inside, shape (m, n).")
      .def_property_readonly("limit", rows_of<std::int16_t>(&WorkspaceSection::limit),
                             "Index into workspace_limits, -1 for none, shape (m, n).")
      .def_property_readonly("condition_number", rows_of<double>(&WorkspaceSection::condition_number),
                             "NaN where no pose is allowed, shape (m, n).")
      .def_property_readonly("fraction", rows_of<double>(&WorkspaceSection::fraction),
                             "Allowed share, shape (m, n); its contour at one half is the boundary.");
  m.def("workspace_field", [](const py::object& map, long most) {
    const WorkspaceMap cells = map_from(map);
    return interruptible(py::none(), [&](const Control& control) { return field_of(cells, most, control.stop); });
  });
  m.def("cell_section", [](const py::object& map, int fixed, double at, int pixels) {
    const WorkspaceMap cells = map_from(map);
    return interruptible(py::none(),
                         [&](const Control& control) { return section_of(cells, fixed, at, pixels, control.stop); });
  });
  m.def("field_section", [](const py::object& map, const WorkspaceField& field, int fixed, double at) {
    const WorkspaceMap cells = map_from(map);
    return interruptible(py::none(),
                         [&](const Control& control) { return section_of(cells, field, fixed, at, control.stop); });
  });
}

}  // namespace ninedof::python
