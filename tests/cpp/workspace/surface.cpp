/// Surfaces of quadrilaterals: closed, outward, of the volume of bodies known in closed form, for a body inside its
/// raster and for one that reaches the last points.

#include "ninedof/workspace/surface.hpp"

#include <map>

#include "support/support.hpp"

using namespace support;
using namespace ninedof;

namespace {

template <class Function>
Raster raster_of(const std::array<std::size_t, 3>& count, const Vec3& first, const Vec3& step, const Function& value) {
  Raster out{count, {}, first, step};
  for (std::size_t i = 0; i < count[0]; ++i)
    for (std::size_t j = 0; j < count[1]; ++j)
      for (std::size_t k = 0; k < count[2]; ++k)
        out.values.push_back(value(
            first + step.cwiseProduct(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)))));
  return out;
}

/// Every directed side of a face is there once, and once in the other direction.
bool is_closed(const QuadSurface& surface) {
  std::map<std::pair<std::int64_t, std::int64_t>, int> sides;
  for (const auto& face : surface.faces)
    for (std::size_t k = 0; k < 4; ++k) ++sides[{face[k], face[(k + 1) % 4]}];
  for (const auto& [side, times] : sides)
    if (const auto back = sides.find({side.second, side.first}); times != 1 || back == sides.end()) return false;
  return !sides.empty();
}

/// Vertices - edges + faces; a closed surface of quadrilaterals has two edges for each face.
std::ptrdiff_t euler(const QuadSurface& surface) {
  return std::ssize(surface.points) - std::ssize(surface.faces);
}

Vec3 middle_of(const QuadSurface& surface, const QuadSurface::Face& face) {
  Vec3 sum = Vec3::Zero();
  for (const std::int64_t n : face) sum += surface.points[at_index(n)];
  return sum / 4.0;
}

const Vec3 ball_centre(0.3, -0.2, 0.1);

double in_ball(const Vec3& x) {
  return 0.8 - (x - ball_centre).norm();
}

double in_torus(const Vec3& x) {
  return 0.25 - std::hypot(std::hypot(x.x(), x.y()) - 0.6, x.z());
}

}  // namespace

TEST_SUITE("surface") {
  TEST_CASE("a ball has the volume and the normals of the closed form") {
    const Raster raster = raster_of({41, 45, 39}, Vec3(-0.7, -1.3, -0.9), Vec3(0.05, 0.05, 0.055), in_ball);
    const QuadSurface surface = surface_net(raster, 0.0, -1.0);
    CHECK(is_closed(surface));
    CHECK(euler(surface) == 2);
    for (const Vec3& point : surface.points) CHECK(std::abs(in_ball(point)) < 2e-3);
    CHECK(enclosed_volume(surface) == doctest::Approx(4.0 / 3.0 * pi * std::pow(0.8, 3)).epsilon(0.005));
    const std::vector<Vec3> normals = surface_normals(surface);
    for (std::size_t n = 0; n < normals.size(); ++n)
      CHECK(normals[n].dot((middle_of(surface, surface.faces[n]) - ball_centre).normalized()) > 0.9);
  }

  TEST_CASE("a torus has one hole, two bodies have two pieces, an empty raster has no faces") {
    const std::array<std::size_t, 3> count{50, 50, 30};
    const QuadSurface torus =
        surface_net(raster_of(count, Vec3(-1.0, -1.0, -0.6), Vec3::Constant(0.0413), in_torus), 0.0, -1.0);
    CHECK(is_closed(torus));
    CHECK(euler(torus) == 0);
    CHECK(enclosed_volume(torus) == doctest::Approx(2.0 * pi * pi * 0.6 * 0.25 * 0.25).epsilon(0.02));
    const auto two = [](const Vec3& x) { return 0.3 - (x - Vec3(x.x() > 0.0 ? 0.5 : -0.5, 0.0, 0.0)).norm(); };
    const QuadSurface balls =
        surface_net(raster_of(count, Vec3(-1.0, -1.0, -0.6), Vec3::Constant(0.0413), two), 0.0, -1.0);
    CHECK(is_closed(balls));
    CHECK(euler(balls) == 4);
    CHECK(surface_net(raster_of(count, Vec3::Zero(), Vec3::Ones(), [](const Vec3&) { return -1.0; }), 0.0, -1.0)
              .faces.empty());
  }

  TEST_CASE("a linear function leaves the volume of the plane that it is zero on, to the last points of the raster") {
    const Vec3 slope(0.3, -0.2, 1.0);
    const auto height = [&](const Vec3& x) { return 2.05 - slope.dot(x); };
    const Raster raster = raster_of({31, 41, 51}, Vec3::Zero(), Vec3::Constant(0.1), height);
    const QuadSurface surface = surface_net(raster, 0.0, -1e12);
    CHECK(is_closed(surface));
    // Above each point of the base, 3 x 4, the height under the plane.
    CHECK(enclosed_volume(surface) == doctest::Approx(12.0 * (2.05 - 0.3 * 1.5 + 0.2 * 2.0)).epsilon(0.006));
    for (const Vec3& point : surface.points)
      if ((point.array() > 0.01).all() && (Vec3(2.99, 3.99, 4.99) - point).minCoeff() > 0.0)
        CHECK(std::abs(height(point)) < 1e-12);
  }

  TEST_CASE("a box that fills its raster ends at it, or within a step") {
    const Raster full = raster_of({3, 4, 5}, Vec3(1.0, 2.0, 3.0), Vec3::Ones(), [](const Vec3&) { return 1.0; });
    CHECK(enclosed_volume(surface_net(full, 0.0, -1e9)) == doctest::Approx(24.0).epsilon(1e-6));
    const QuadSurface wide = surface_net(full, 0.25, 0.0);
    CHECK(is_closed(wide));
    CHECK(enclosed_volume(wide) > 24.0);
    CHECK(enclosed_volume(wide) < 4.0 * 5.0 * 6.0);
  }

  TEST_CASE("invalid arguments are named") {
    Raster raster = raster_of({3, 3, 3}, Vec3::Zero(), Vec3::Ones(), in_ball);
    CHECK(message_of([&] { surface_net(raster, 0.0, 0.5); }).starts_with("outside: got 0.5"));
    raster.values.pop_back();
    CHECK(message_of([&] { surface_net(raster, 0.0, -1.0); }).starts_with("raster: got 26 values, expected 27"));
  }
}
