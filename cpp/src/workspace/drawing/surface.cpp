#include "ninedof/workspace/surface.hpp"

#include <Eigen/Geometry>
#include <bit>

#include "ninedof/math/error.hpp"
#include "workspace/drawing/raster.hpp"

namespace ninedof {
namespace {

/// Corner n of a unit cube, in the order of a raster.
Vec3 cube_corner(unsigned n) {
  return {static_cast<double>(n >> 2), static_cast<double>((n >> 1) & 1), static_cast<double>(n & 1)};
}

/// The mean of the places on the edges of a unit cube where values at its corners cross a level.
Vec3 mean_crossing(const std::array<double, 8>& values, double level) {
  Vec3 sum = Vec3::Zero();
  double crossings = 0.0;
  for (unsigned a = 0; a < 8; ++a)
    for (unsigned b = a + 1; b < 8; ++b) {
      if (std::popcount(a ^ b) != 1 || (values[a] > level) == (values[b] > level)) continue;
      const double t = (level - values[a]) / (values[b] - values[a]);
      sum += cube_corner(a) + t * (cube_corner(b) - cube_corner(a));
      crossings += 1.0;
    }
  return sum / crossings;
}

/// Adds a vertex for each cube with points on both sides of the level; returns their numbers at its lowest corner.
std::vector<std::int64_t> add_vertices(const Raster& raster, double level, QuadSurface& surface) {
  std::vector<std::int64_t> number(raster.values.size(), -1);
  const auto [x, y, z] = strides(raster.count);
  const auto [nx, ny, nz] = raster.count;
  const std::array<std::size_t, 8> corners{0, z, y, y + z, x, x + z, x + y, x + y + z};
  for_each_point({nx - 1, ny - 1, nz - 1}, raster.count,
                 [&](std::size_t i, std::size_t j, std::size_t k, std::size_t n) {
                   std::array<double, 8> values{};
                   int above = 0;
                   for (std::size_t c = 0; c < 8; ++c) {
                     values[c] = raster.values[n + corners[c]];
                     above += values[c] > level ? 1 : 0;
                   }
                   if (above == 0 || above == 8) return;
                   number[n] = static_cast<std::int64_t>(surface.points.size());
                   const Vec3 at(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
                   surface.points.push_back(raster.first + raster.step.cwiseProduct(at + mean_crossing(values, level)));
                 });
  return number;
}

}  // namespace

QuadSurface surface_net(const Raster& raster, double level, double outside) {
  if (const auto [x, y, z] = raster.count; raster.values.size() != x * y * z)
    throw InvalidArgument("raster", std::to_string(raster.values.size()) + " values", std::to_string(x * y * z));
  if (!(outside <= level)) throw InvalidArgument("outside", format_number(outside), "at most the level");
  // The outermost points are outside, so that every edge between the kinds has four cubes around it.
  const Raster wide = padded(raster, outside);
  QuadSurface out;
  const std::vector<std::int64_t> number = add_vertices(wide, level, out);
  const auto stride = strides(wide.count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = stride[(axis + 1) % 3], v = stride[(axis + 2) % 3];
    std::array<std::size_t, 3> edges = wide.count;
    --edges[axis];
    for_each_point(edges, wide.count, [&](std::size_t, std::size_t, std::size_t, std::size_t n) {
      const bool here = wide.values[n] > level, next = wide.values[n + stride[axis]] > level;
      if (here == next) return;
      const std::int64_t a = number[n - u - v], b = number[n - v], c = number[n], d = number[n - u];
      out.faces.push_back(here ? QuadSurface::Face{a, b, c, d} : QuadSurface::Face{d, c, b, a});
    });
  }
  return out;
}

std::vector<Vec3> surface_normals(const QuadSurface& surface) {
  std::vector<Vec3> out;
  for (const auto& [a, b, c, d] : surface.faces) {
    const auto& p = surface.points;
    const Vec3 across = (p[at_index(c)] - p[at_index(a)]).cross(p[at_index(d)] - p[at_index(b)]);
    out.push_back(across / std::max(across.norm(), 1e-300));
  }
  return out;
}

double enclosed_volume(const QuadSurface& surface) {
  double six = 0.0;
  for (const auto& [a, b, c, d] : surface.faces) {
    const auto& p = surface.points;
    six += p[at_index(a)].dot((p[at_index(b)] - p[at_index(d)]).cross(p[at_index(c)]));
  }
  return six / 6.0;
}

}  // namespace ninedof
