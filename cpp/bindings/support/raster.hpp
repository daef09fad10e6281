#pragma once
/// Rasters and surfaces as Python keeps them: three axes and the values at their points; points and faces.

#include <algorithm>
#include <array>

#include "ninedof/workspace/surface.hpp"
#include "support/columns.hpp"

namespace ninedof::python {

using Axes = std::array<Array, 3>;

inline Raster raster_from(const Axes& axes, const Array& values) {
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

inline Array values_of(const Raster& raster) {
  std::vector<py::ssize_t> shape;
  for (const std::size_t count : raster.count) shape.push_back(static_cast<py::ssize_t>(count));
  return column<double>(raster.values, shape);
}

inline py::tuple axes_of(const Raster& raster) {
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

inline py::tuple points_and_faces(const QuadSurface& surface) {
  py::array_t<std::int64_t> faces(std::vector<py::ssize_t>{std::ssize(surface.faces), 4});
  std::int64_t* to = faces.mutable_data();
  for (const QuadSurface::Face& face : surface.faces) to = std::ranges::copy(face, to).out;
  return py::make_tuple(array_from(surface.points), faces);
}

}  // namespace ninedof::python
