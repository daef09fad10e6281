/// region.hpp, region_sample.hpp: coordinates, the nearest pose, even samples by their moments, corners.

#include "ninedof/domains/region.hpp"

#include <doctest/doctest.h>

#include "ninedof/domains/region_sample.hpp"
#include "ninedof/math/rotation.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

Region region_of(Region::Shape shape) {
  Region out;
  out.shape = shape;
  out.size = shape == Region::Shape::box        ? Vec3(1.0, 0.5, 2.0)
             : shape == Region::Shape::cylinder ? Vec3(2.0, 0.0, 0.5)
                                                : Vec3(2.0, 0.0, 0.0);
  out.tilt = 0.5;
  out.yaw = 1.0;
  if (shape == Region::Shape::path) out.corners = {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(3, 1, 0)};
  return out;
}

const std::vector<Region::Shape> shapes{Region::Shape::box, Region::Shape::ball, Region::Shape::cylinder,
                                        Region::Shape::path};

}  // namespace

TEST_SUITE("region") {
  TEST_CASE("samples and moved poses are in the region") {
    for (const Region::Shape shape : shapes) {
      const Region region = region_of(shape);
      region.validate();
      for (long n = 0; n < 2000; ++n) {
        const Vec6 at = region_sample(region, n, 7);
        CHECK((region.nearest(at) - at).norm() <= 1e-14);
        const Vec6 moved = region.nearest(region_moved(region, at, static_cast<int>(n % region_moves), 0.3));
        CHECK((region.nearest(moved) - moved).norm() <= 1e-14);
      }
    }
  }

  TEST_CASE("slopes of the nearest coordinates against differences") {
    constexpr double h = 1e-6;
    for (const Region::Shape shape : shapes) {
      const Region region = region_of(shape);
      for (long n = 0; n < 500; ++n) {
        const Vec6 at = (static_cast<double>(n % 3) + 0.5) * region_sample(region, n, 9);  // within and beside it
        const Mat6 slopes = region.nearest_slopes(at);
        for (int k = 0; k < 6; ++k) {
          const Vec6 e = h * Vec6::Unit(k);
          CHECK((slopes.col(k) - (region.nearest(at + e) - region.nearest(at - e)) / (2.0 * h)).norm() <= 1e-8);
        }
      }
    }
  }

  TEST_CASE("the coordinates of a pose are those that it was made of") {
    for (const Region::Shape shape : shapes) {
      const Region region = region_of(shape);
      for (long n = 0; n < 2000; ++n) {
        const Vec6 at = region_sample(region, n, 8);
        CHECK((region.coordinates(region.pose(at)) - at).norm() <= 1e-12);
      }
    }
  }

  TEST_CASE("an even sample has the moments of the region") {
    for (const Region::Shape shape : shapes) {
      const Region region = region_of(shape);
      const long count = 20'000;
      Vec6 mean = Vec6::Zero(), square = Vec6::Zero();
      for (long n = 0; n < count; ++n) {
        const Vec6 at = even_sample(region, n, n % 2 == 0 ? 0 : 3);
        mean += at / count;
        square += at.cwiseAbs2() / count;
      }
      // A disc has r^2 / 4 along each axis, a ball r^2 / 5, an interval h^2 / 3.
      Vec6 expected;
      expected << Vec3::Constant(0.8), 0.0625, 0.0625, 1.0 / 3.0;
      if (shape == Region::Shape::box) expected.head<3>() = region.size.cwiseAbs2() / 3.0;
      if (shape == Region::Shape::cylinder) expected.head<3>() << 1.0, 1.0, 0.25 / 3.0;
      if (shape == Region::Shape::path) expected.head<3>() << 1.0 / 3.0, 0.0, 0.0;
      CHECK(mean.cwiseAbs().maxCoeff() < 5e-3);
      CHECK((square - expected).cwiseAbs().maxCoeff() < 5e-3);
    }
  }

  TEST_CASE("corners: each once, at the greatest tilt") {
    const Region box = region_of(Region::Shape::box);
    const std::vector<Vec6> corners = region_corners(box, 8);
    CHECK(corners.size() == 16 * 8);
    for (const Vec6& at : corners) {
      CHECK((at.head<3>().cwiseAbs() - box.size).norm() < 1e-15);
      CHECK(at.segment<2>(3).norm() == doctest::Approx(0.5));
      CHECK(std::abs(at[5]) == 1.0);
    }
    Region still;
    CHECK(region_corners(still, 8).size() == 1);
  }

  TEST_CASE("the configuration of a pose: shifted, turned about a horizontal axis after the yaw, O carried or held") {
    Random random(3);
    const Configuration neutral{Vec3(0, 0, 4), random.rotation(), Vec3(0.1, 0.2, 2.5)};
    for (const bool shifted : {true, false}) {
      Region region = region_of(Region::Shape::box);
      region.shifted = shifted;
      region.in_zp = true;
      const Vec6 at = region_sample(region, 12, 1);
      const Configuration c = region.configuration(at, neutral);
      const Vec3 moved = 4.0 * at.head<3>(), tilt(at[3], at[4], 0.0);
      const Mat3 turn = (Eigen::AngleAxisd(tilt.norm(), tilt.normalized()) * Eigen::AngleAxisd(at[5], Vec3::UnitZ()))
                            .toRotationMatrix();
      CHECK((c.position - neutral.position - moved).norm() < 1e-14);
      CHECK((c.rotation - turn * neutral.rotation).norm() < 1e-14);
      CHECK((c.internal_point - neutral.internal_point - (shifted ? moved : Vec3(0, 0, 0))).norm() < 1e-14);
    }
  }

  TEST_CASE("the slopes of a pose against difference quotients") {
    constexpr double h = 1e-5;
    for (const Region::Shape shape : shapes)
      for (const bool shifted : {true, false})
        for (const double angle : {0.5, 2.5}) {
          Region region = region_of(shape);
          region.shifted = shifted;
          region.tilt = angle;
          for (long n = 0; n < 200; ++n) {
            const Vec6 at = n == 0 ? Vec6(Vec6::Zero()) : even_sample(region, n, 11);
            if (shape == Region::Shape::path && std::abs(at[0] - 0.5) < 1e-3) continue;  // at the corner
            if (shape == Region::Shape::path) {
              const auto [way, from, to] = region.straight(at[0]);
              CHECK((from <= at[0] && at[0] <= to && (from == 0.5 || to == 0.5)));
            }
            const PoseSlopes slopes = region.slopes(at);
            const Mat3 here = exp_rotation(region.pose(at).rotation);
            for (int k = 0; k < 6; ++k) {
              const Pose up = region.pose(at + h * Vec6::Unit(k)), down = region.pose(at - h * Vec6::Unit(k));
              CHECK(((up.position - down.position) / (2.0 * h) - slopes.position.col(k)).norm() < 1e-9);
              CHECK(((up.internal - down.internal) / (2.0 * h) - slopes.internal.col(k)).norm() < 1e-9);
              const Vec3 turn = log_rotation(exp_rotation(up.rotation) * here.transpose()) -
                                log_rotation(exp_rotation(down.rotation) * here.transpose());
              CHECK((turn / (2.0 * h) - slopes.turn.col(k)).norm() < 1e-8);
            }
          }
        }
  }
}
