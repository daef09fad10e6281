#include "ninedof/workspace/surface.hpp"

#include "support/columns.hpp"
#include "support/module.hpp"

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
  m.def("surface_normals",
        [](const py::object& surface) { return array_from(surface_normals(surface_from(surface))); });
  m.def("enclosed_volume", [](const py::object& surface) { return enclosed_volume(surface_from(surface)); });
}

}  // namespace ninedof::python
