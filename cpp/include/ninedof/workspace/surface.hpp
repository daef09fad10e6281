#pragma once
/// The boundary of a body as a closed surface of quadrilaterals, for drawing.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Numbers at the points first + (i, j, k) * step of an even raster, those along z next to each other.
struct Raster {
  std::array<std::size_t, 3> count{};
  std::vector<double> values;
  Vec3 first = Vec3::Zero(), step = Vec3::Ones();
};

/// A closed surface; seen from outside the corners of a face run counterclockwise.
struct QuadSurface {
  using Face = std::array<std::int64_t, 4>;
  std::vector<Vec3> points;
  std::vector<Face> faces;  ///< numbers of points
};

/// The surface about the values above a level: a surface net (Gibson, 1998), not relaxed. Beyond the raster the values
/// are `outside`, at most `level`: a body that reaches the last points ends within a step of them, and at them where
/// `outside` is far below the level.
///
/// Each cube of eight points with both kinds has one vertex, the mean of the places on its edges where the level is
/// crossed; each edge between the kinds has one face, of the vertices of the four cubes around it.
/// Throws InvalidArgument for a raster without its number of values, and for `outside` above the level.
QuadSurface surface_net(const Raster& raster, double level, double outside);

/// Outward unit normals of the faces; 0 of a face without area.
std::vector<Vec3> surface_normals(const QuadSurface& surface);

/// Volume enclosed, by the divergence theorem.
double enclosed_volume(const QuadSurface& surface);

}  // namespace ninedof
