/// trilateration.hpp: the point of three spheres and the bound of its error, against long double.

#include "ninedof/position/trilateration.hpp"

#include <doctest/doctest.h>

#include <array>

#include "support/support.hpp"

using namespace support;
using ninedof::meet;
using ninedof::Meeting;
using ninedof::SphereCentres;

namespace {

using Wide = Eigen::Matrix<long double, 3, 1>;

/// The common point above the plane, from the definition; `height2` may be negative.
struct Exact {
  Wide above;
  long double height2;
};
Exact exact(const Triple& centres, const Vec3& radii) {
  const Wide a = centres[0].cast<long double>(), b = centres[1].cast<long double>() - a,
             c = centres[2].cast<long double>() - a;
  const Wide e1 = b / b.norm(), across = c - c.dot(e1) * e1, e2 = across / across.norm();
  const long double r1 = radii[0], r2 = radii[1], r3 = radii[2], i = c.dot(e1), j = across.norm(), length = b.norm();
  const long double x = (r1 * r1 - r2 * r2 + length * length) / (2 * length);
  const long double y = (r1 * r1 - r3 * r3 + i * i + j * j - 2 * x * i) / (2 * j);
  const long double height2 = r1 * r1 - x * x - y * y;
  return {a + x * e1 + y * e2 + std::sqrt(std::max(0.0L, height2)) * e1.cross(e2), height2};
}

struct Spheres {
  Triple centres;
  Vec3 radii;
};

/// Around a point at a height over the plane, a share of its distance from the first centre.
Spheres around_point(Random& random, double share, double plate) {
  Spheres out;
  for (Vec3& centre : out.centres) centre = plate * random.matrix<Vec3>();
  const SphereCentres at(out.centres);
  const Vec3 point = out.centres[0] + random.normal() * at.e1 + random.normal() * at.e2;
  const Vec3 raised = point + share * (point - out.centres[0]).norm() * at.e3;
  for (Eigen::Index k = 0; k < 3; ++k) out.radii[k] = (raised - out.centres[static_cast<std::size_t>(k)]).norm();
  return out;
}

}  // namespace

TEST_SUITE("trilateration") {
  TEST_CASE("the point is nowhere further from the exact one than its bound says, low over the plane too") {
    Random random(1);
    int met = 0;
    for (int n = 0; n < 4000; ++n) {
      const Spheres s = around_point(random, random.log_uniform(1e-8, 10.0), random.log_uniform(0.01, 10.0));
      const Meeting m = meet(SphereCentres(s.centres), s.radii);
      if (m.kind != Meeting::two_points) continue;
      ++met;
      const Exact right = exact(s.centres, s.radii);
      REQUIRE(right.height2 > 0.0L);
      const auto miss = static_cast<double>((m.above.cast<long double>() - right.above).norm());
      CHECK(miss <= m.error + 8.0 * eps * m.above.norm());
    }
    CHECK(met > 3000);
  }

  TEST_CASE("all three distances to rounding, from plates a thousandth as large") {
    Random random(2);
    for (int n = 0; n < 2000; ++n) {
      const Spheres s = around_point(random, random.log_uniform(0.1, 10.0), random.log_uniform(0.001, 0.3));
      const Meeting m = meet(SphereCentres(s.centres), s.radii);
      REQUIRE(m.kind == Meeting::two_points);
      for (std::size_t k = 0; k < 3; ++k) {
        const double radius = s.radii[static_cast<Eigen::Index>(k)];
        CHECK(std::abs((m.above - s.centres[k]).norm() - radius) <= 3.0 * eps * (radius + s.centres[k].norm()));
      }
    }
  }

  TEST_CASE("spheres that miss each other have no point, and say so with certainty") {
    const SphereCentres at({Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0)});
    const Meeting none = meet(at, {0.1, 0.1, 0.1});
    CHECK(none.kind == Meeting::none);
    CHECK(none.height2 < 0.0);
    CHECK(none.certain);
    CHECK(meet(at, Vec3::Constant(std::sqrt(0.5))).kind == Meeting::touching);
  }
}
