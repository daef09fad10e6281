/// pose.hpp: the pose of a proof at coordinates of a region. Oracle: Region itself.

#include <doctest/doctest.h>

#include "ninedof/domains/region_sample.hpp"
#include "proof/region/pose.hpp"

using namespace ninedof;

TEST_SUITE("region_pose") {
  TEST_CASE("a point has the pose that the region has at its coordinates, on every way of a path") {
    const Configuration neutral{Vec3(0.0, 0.0, 2.0), Mat3::Identity(), Vec3(0.0, 0.0, 1.0)};
    for (const Region::Shape shape :
         {Region::Shape::box, Region::Shape::ball, Region::Shape::cylinder, Region::Shape::path}) {
      Region region;
      region.shape = shape;
      region.size = Vec3(0.3, 0.2, 0.1);
      region.tilt = 0.2;
      region.yaw = 0.1;
      if (shape == Region::Shape::path)
        region.corners = {Vec3(0.0, 0.0, 0.0), Vec3(0.3, 0.0, 0.1), Vec3(0.3, 0.0, 0.1), Vec3(0.0, 0.4, 0.2)};
      const PosedRobot machine{Geometry::hexagonal(0.0, 1.0, 0.5, 0.0), neutral, 1.0, {region}, {}, {}};
      const over_region::Domain domain(machine);
      for (long n = 0; n < 200; ++n) {
        const Vec6 at = region_sample(region, n, 3);
        const over_region::Box point = domain.point(at);
        const Configuration here = domain.configuration(point), there = region.configuration(at, neutral);
        CHECK((here.position - there.position).norm() < 1e-11);
        CHECK((here.internal_point - there.internal_point).norm() < 1e-11);
        CHECK((here.rotation - there.rotation).norm() < 1e-11);
        CHECK_FALSE(domain.outside(point));
      }
    }
  }
}
