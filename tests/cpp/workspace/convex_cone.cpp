/// Cones over boxes and their distances, compared with points drawn in the boxes and on the cones.

#include "workspace/criteria/convex_cone.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "support/support.hpp"

using namespace support;
using ninedof::ConvexCone;

namespace {

double cone_angle(const Vec3& leg, const Vec3& axis) {
  return std::atan2(leg.cross(axis).norm(), leg.dot(axis));
}

Vec3 in_box(Random& random, const Vec3& centre, const Vec3& half) {
  return centre +
         Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)).cwiseProduct(half);
}

}  // namespace

TEST_SUITE("convex_cone") {
  TEST_CASE("cones over a box: no point contradicts, and small boxes off the boundary are decided") {
    Random random(1);
    int allowed = 0, forbidden = 0;
    for (int n = 0; n < 4000; ++n) {
      const Vec3 axis = random.unit(), centre = random.log_uniform(0.1, 3.0) * random.unit();
      const Vec3 half = random.log_uniform(1e-3, 1.0) * random.unit().cwiseAbs();
      const double angle = random.uniform(0.01, std::numbers::pi - 0.01);  // obtuse ones too
      const ConvexCone cone(2.0 * axis, angle);
      const bool all = cone.allows_box(centre, half, 0.0), none = cone.forbids_box(centre, half, 0.0);
      CHECK_FALSE((all && none));
      allowed += all;
      forbidden += none;
      for (int k = 0; k < 40; ++k) {
        const bool within = cone_angle(in_box(random, centre, half), axis) <= angle;
        CHECK((within ? !none : !all));
      }
      // The change of the angle over the box is at most that over the ball around it.
      const double reach = half.norm() / centre.norm(), off = angle - cone_angle(centre, axis);
      if (reach < 0.5 && off > 1.01 * std::asin(reach)) CHECK(all);
      if (reach < 0.5 && off < -1.01 * std::asin(reach)) CHECK(none);
    }
    CHECK(allowed > 500);
    CHECK(forbidden > 500);
  }

  TEST_CASE("the distance from a cone is that of the nearest point of its boundary") {
    Random random(2);
    for (int n = 0; n < 200; ++n) {
      const Vec3 axis = random.unit(), v = random.log_uniform(0.1, 3.0) * random.unit();
      const double angle = random.uniform(0.1, std::numbers::pi - 0.1);
      const Vec3 side = axis.unitOrthogonal(), up = axis.cross(side);
      double nearest = v.norm();  // the apex
      for (int k = 0; k < 4000; ++k) {
        const double turn = 2.0 * std::numbers::pi * k / 4000;
        const Vec3 way = std::cos(angle) * axis + std::sin(angle) * (std::cos(turn) * side + std::sin(turn) * up);
        nearest = std::min(nearest, (v - std::max(0.0, v.dot(way)) * way).norm());
      }
      const double clear = ConvexCone(axis, angle).clear(v);
      CHECK((clear >= 0.0) == (cone_angle(v, axis) <= angle));
      CHECK(std::abs(std::abs(clear) - nearest) < 1e-5 * v.norm() + 1e-3 * v.norm() * (nearest < 1e-2 * v.norm()));
    }
  }
}
