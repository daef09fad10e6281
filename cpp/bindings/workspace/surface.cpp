#include "ninedof/workspace/surface.hpp"

#include <pybind11/stl.h>

#include "support/columns.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/raster.hpp"

namespace ninedof::python {
namespace {

using Faces = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// A WorkspaceSurface: faces that name points of its own.
QuadSurface surface_from(const py::object& surface) {
  QuadSurface out{points_from("points", surface.attr("points")), {}};
  const auto faces = surface.attr("faces").cast<Faces>();
  if (faces.ndim() != 2 || faces.shape(1) != 4) throw InvalidArgument("faces", "another shape", "shape (n, 4)");
  for (const std::int64_t* from = faces.data(); from != faces.data() + faces.size(); from += 4) {
    out.faces.push_back({from[0], from[1], from[2], from[3]});
    for (const std::int64_t n : out.faces.back())
      if (n < 0 || n >= std::ssize(out.points))
        throw InvalidArgument("faces", std::to_string(n),
                              "numbers of points, below " + std::to_string(out.points.size()));
  }
  return out;
}

}  // namespace

void bind_workspace_surface(py::module_& m) {
  m.def("surface_net", [](const Axes& axes, const Array& values, double level, double outside) {
    const auto raster = raster_from(axes, values);
    return points_and_faces(
        interruptible(py::none(), [&](const Control&) { return surface_net(raster, level, outside); }));
  });
  m.def("surface_normals",
        [](const py::object& surface) { return array_from(surface_normals(surface_from(surface))); });
  m.def("enclosed_volume", [](const py::object& surface) { return enclosed_volume(surface_from(surface)); });
  m.def("smoothed_points", [](const py::object& surface, int rounds) {
    const auto given = surface_from(surface);
    return array_from(interruptible(py::none(), [&](const Control&) { return smoothed_points(given, rounds); }));
  });
}

}  // namespace ninedof::python
