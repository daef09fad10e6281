/// path_bounds.hpp: bounds of the motion of O against the motion itself, in long double.

#include "position/path_bounds.hpp"

#include <doctest/doctest.h>

#include <array>

#include "support/support.hpp"

using namespace support;
using ninedof::path_bounds;
using ninedof::PathBounds;
using ninedof::PlatePoint;
using ninedof::SphereCentres;

namespace {

/// x, y and height of O for radii, from the definition.
std::array<long double, 3> place(const SphereCentres& plate, const Eigen::Matrix<long double, 3, 1>& r) {
  const long double length = plate.length, i = plate.i, j = plate.j;
  const long double x = (r[0] * r[0] - r[1] * r[1] + length * length) / (2 * length);
  const long double y = (r[0] * r[0] - r[2] * r[2] + i * i + j * j - 2 * x * i) / (2 * j);
  return {x, y, std::sqrt(r[0] * r[0] - x * x - y * y)};
}

}  // namespace

TEST_SUITE("path_bounds") {
  TEST_CASE("speed and acceleration of O are never larger, and seldom much smaller") {
    Random random(1);
    int bounded = 0, sharp = 0, on_plane = 0;
    for (int n = 0; n < 4000; ++n) {
      const SphereCentres plate({random.matrix<Vec3>(), random.matrix<Vec3>(), random.matrix<Vec3>()});
      const Vec3 point = random.log_uniform(0.1, 10.0) * random.unit();
      Vec3 from;
      for (Eigen::Index k = 0; k < 3; ++k) from[k] = (point - plate.centre[static_cast<std::size_t>(k)]).norm();
      const Vec3 to = from + random.log_uniform(1e-4, 0.3) * random.matrix<Vec3>();
      const ninedof::Meeting end = ninedof::meet(plate, to);
      if (to.minCoeff() <= 0.0 || end.kind != ninedof::Meeting::two_points) continue;
      const PathBounds b = path_bounds(plate, {plate, point, from}, {plate, end.above, to});
      // Differences over steps of a thousandth.
      constexpr long double step = 1e-3L;
      const Eigen::Matrix<long double, 3, 1> start = from.cast<long double>(), rate = (to - from).cast<long double>();
      double speed = 0.0, acceleration = 0.0;
      for (int k = 0; k < 40; ++k) {
        const long double t = 0.025L * k + 0.01L;
        const auto before = place(plate, start + (t - step) * rate), at = place(plate, start + t * rate),
                   after = place(plate, start + (t + step) * rate);
        long double v2 = 0, a2 = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const long double v = (after[i] - before[i]) / (2 * step),
                            a = (after[i] - 2 * at[i] + before[i]) / (step * step);
          v2 += v * v;
          a2 += a * a;
        }
        // NaN where the spheres do not meet on the way: then the bounds must be infinite.
        speed = std::isnan(v2) ? infinity : std::max(speed, static_cast<double>(std::sqrt(v2)));
        acceleration = std::isnan(a2) ? infinity : std::max(acceleration, static_cast<double>(std::sqrt(a2)));
      }
      if (std::isinf(speed)) CHECK(std::isinf(b.speed));
      if (std::isinf(b.speed)) {
        ++on_plane;
        continue;
      }
      ++bounded;
      CHECK(b.speed >= speed * (1.0 - 1e-4));
      CHECK(b.acceleration >= acceleration * (1.0 - 1e-3) - 1e-9);
      sharp += b.speed < 1.5 * speed ? 1 : 0;
    }
    CHECK(bounded > 2000);
    CHECK(on_plane > 50);
    CHECK(sharp > bounded / 2);
  }
}
