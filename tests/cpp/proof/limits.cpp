/// machine.hpp: the worst value of every limit over all poses of a machine lies in what it is enclosed in. Oracle: the
/// same limits at thousands of poses of the region, by joints and legs.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "limits/table.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/problem/problem.hpp"
#include "ninedof/proof/machine.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

const std::vector<Limit> every{{.name = "radius_ratio", .low = 0.5, .high = 2.0},
                               {.name = "leg_ratio", .high = 3.0},
                               {.name = "stroke_ratio", .high = 1.3},
                               {.name = "stroke", .high = 0.2, .of = Unit::zp},
                               {.name = "zs_fraction", .low = 0.1, .high = 0.9},
                               {.name = "leg_length", .low = 0.1, .high = 2.0, .of = Unit::zp},
                               {.name = "lower_length", .low = 0.5, .high = 9.0},
                               {.name = "height", .low = 1.0, .high = 9.0},
                               {.name = "footprint", .low = 1.0, .high = 9.0},
                               {.name = "joint_height", .high = 0.5, .of = Unit::radius},
                               {.name = "joint_spacing", .low = 0.1, .of = Unit::radius},
                               {.name = "base_cone", .high = 0.5},
                               {.name = "platform_cone", .high = 1.2, .axis = {0.0, 0.2, -1.0}},
                               {.name = "platform_cone", .high = 1.2, .axis = {0.0, 0.0, -1.0}, .at = LimitAt::neutral},
                               {.name = "leg_clearance", .low = 0.1},
                               {.name = "fault_tolerant", .high = 1.01},
                               {.name = "singularity_free", .low = 0.01}};

/// The worst value of a limit over poses.
double worst(const LimitOverPoses& limit, const Limit& given, const Geometry& g, const std::vector<PosedPoints>& all) {
  const LimitRow& row = limit_row(given.name);
  const bool most = limit.side == Side::high;
  double out = most ? -1e300 : 1e300;
  const auto take = [&](double value) { out = most ? std::max(out, value) : std::min(out, value); };
  if (row.pose != nullptr) {
    const std::size_t count = limit.at_neutral ? 1 : all.size();
    for (std::size_t k = 0; k < count; ++k)
      for (int item = 0; item < row.pose->items; ++item) take(row.pose->number({all[k], all[0], given.axis}, item));
    return out;
  }
  if (row.spread != nullptr) {
    Vec9 longest = all[0].legs.length, shortest = longest;
    for (const PosedPoints& pose : all) {
      longest = longest.cwiseMax(pose.legs.length);
      shortest = shortest.cwiseMin(pose.legs.length);
    }
    if (given.name == "leg_ratio") return longest.maxCoeff() / shortest.minCoeff();
    for (int leg = 0; leg < 9; ++leg)
      take(given.name == "stroke" ? longest[leg] - shortest[leg] : longest[leg] / shortest[leg]);
    return out;
  }
  const auto radius = [](const Triple& a, const Triple& b) {
    double r = 0.0;
    for (const Triple* t : {&a, &b})
      for (const Vec3& x : *t) r = std::max(r, x.head<2>().norm());
    return r;
  };
  const double base = radius(g.base_external(), g.base_internal()),
               platform = radius(g.platform_external(), g.platform_internal());
  if (given.name == "radius_ratio") return base / platform;
  if (given.name == "footprint") return base;
  if (given.name == "height") return all[0].at[point_p].z();
  if (given.name == "zs_fraction") return all[0].at[point_s].z() / all[0].at[point_p].z();
  const std::array bodies{std::pair{&g.base_external(), &g.base_internal()},
                          std::pair{&g.platform_external(), &g.platform_internal()}};
  for (const auto& [external, internal] : bodies) {
    std::vector<Vec3> joints(external->begin(), external->end());
    joints.insert(joints.end(), internal->begin(), internal->end());
    for (std::size_t a = 0; a < joints.size(); ++a) {
      if (given.name == "joint_height") take(std::abs(joints[a].z()));
      for (std::size_t b = 0; b < a && given.name == "joint_spacing"; ++b)
        take((joints[a] - joints[b]).norm() / radius(*external, *internal));
    }
  }
  return out;
}

double widest(const Geometry& g) {
  double r = 0.0;
  for (const Triple* t : {&g.base_external(), &g.base_internal(), &g.platform_external(), &g.platform_internal()})
    for (const Vec3& x : *t) r = std::max(r, x.head<2>().norm());
  return r;
}

Configuration met(const PosedRobot& machine, const MetAt& at) {
  Configuration c = machine.neutral;
  c.position += at.shift;
  if (machine.region.front().shifted) c.internal_point += at.shift;
  if (at.tilt.norm() > 0.0) c.rotation = Eigen::AngleAxisd(at.tilt.norm(), at.tilt.normalized()).toRotationMatrix();
  return c;
}

}  // namespace

TEST_SUITE("limits") {
  TEST_CASE("the worst of every limit over a region is in its enclosure, and met") {
    Random random(9);
    for (int n = 0; n < cases(6); ++n) {
      const Robot robot = random_symmetric_robot(random);
      const double zp = 4.0;
      Region region;
      region.size = {0.2, 0.2, 0.1};
      region.tilt = 0.1;
      region.shifted = n % 2 == 0;
      const PosedRobot machine{robot.geometry, neutral(zp, 2.2), 1.0, {region}, {}, {}};
      const LimitsOverPoses found = limits_over_poses(machine, every, {}, 1e-6, {.seconds = 6.0});
      std::vector<PosedPoints> all{posed_points(machine.geometry, machine.neutral)};
      for (int k = 0; k < cases(4000); ++k) {
        Vec6 at = random.matrix<Vec6>().cwiseProduct(region.reach());
        const Pose pose = region.pose(region.nearest(at));
        Configuration c = machine.neutral;
        c.position += pose.position;
        c.internal_point += pose.internal;
        c.rotation = Eigen::AngleAxisd(pose.rotation.norm(), pose.rotation.normalized()).toRotationMatrix();
        if (!(pose.rotation.norm() > 0.0)) c.rotation.setIdentity();
        all.push_back(posed_points(machine.geometry, c));
      }
      REQUIRE(found.limits.front().name == "no singularity");
      std::size_t k = 1;
      for (const Limit& limit : every)
        for (const Side side : {Side::low, Side::high}) {
          const double given = side == Side::low ? limit.low : limit.high;
          if (!(given > 0.0) || !std::isfinite(given)) continue;
          REQUIRE(k < found.limits.size());
          const LimitOverPoses& one = found.limits[k++];
          CAPTURE(one.name);
          CHECK(one.name == limit.label());
          CHECK(one.side == side);
          const double unit = limit.of == Unit::zp ? zp : limit.name == "joint_height" ? widest(machine.geometry) : 1.0;
          CHECK(one.limit == doctest::Approx(given * unit).epsilon(1e-14));
          const PoseRow* row = limit_row(limit.name).pose;
          CHECK(one.at.size() == (row != nullptr ? 1 : limit_row(limit.name).spread != nullptr ? 2 : 0));
          if (row != nullptr) {
            const PosedPoints there = one.at_neutral ? all[0] : posed_points(machine.geometry, met(machine, one.at[0]));
            double here = std::numeric_limits<double>::quiet_NaN();
            for (int item = 0; item < row->items; ++item)
              if (row->part(item) == one.part) here = row->number({there, all[0], limit.axis}, item);
            CHECK(here >= one.value.lo - 1e-9);
            CHECK(here <= one.value.hi + 1e-9);
          }
          const double value = worst(one, limit, machine.geometry, all), room = 1e-12 * std::abs(value);
          if (side == Side::high) CHECK(value <= one.value.hi + room);
          else CHECK(value >= one.value.lo - room);
          if (row != nullptr && row->first_locked >= 0) {  // roughly, where it is decided
            CHECK(one.value.lo >= 0.99 * value);
            CHECK((one.answer == LimitOverPoses::Answer::violated) == (one.value.lo > one.limit));
            continue;
          }
          CHECK(width(one.value) <= 0.05 * std::max(std::abs(one.value.lo), 0.1));
          CHECK(std::abs(value - middle(one.value)) <= 0.1 * std::max(std::abs(value), 0.1));
        }
      CHECK(k == found.limits.size());
      for (int leg = 0; leg < 9; ++leg)
        CHECK(std::ranges::all_of(all, [&](const PosedPoints& pose) {
          return contains(found.lengths[static_cast<std::size_t>(leg)], pose.legs.length[leg]);
        }));
    }
  }

  TEST_CASE("errors of the platform: none beyond what is proved, and the bound is near that of first order") {
    Random random(4);
    for (int n = 0; n < cases(4); ++n) {
      const Robot robot = random_symmetric_robot(random);
      PosedRobot machine{robot.geometry, neutral(4.0, 2.2), 1.0, {}, {}, {}};
      machine.tolerances.legs.setConstant(1e-5);
      machine.tolerances.joints.fill(3e-5);
      const ErrorOverPoses found = error_over_poses(machine, {.gap = 0.05});
      const ErrorBounds first = error_bounds(machine.geometry, machine.neutral, machine.tolerances);
      const std::array bounds{first.rotation, first.position, first.internal_point};
      const std::array ranges{found.rotation, found.position, found.internal_point};
      for (std::size_t k = 0; k < bounds.size(); ++k) {
        CHECK(ranges[k].lo >= bounds[k] * (1.0 - 1e-9));  // of the machine within tolerances that errs most
        CHECK(ranges[k].lo <= bounds[k] * 1.01);
        CHECK(ranges[k].hi <= 1.07 * bounds[k]);
      }
      for (std::uint64_t k = 0; k < 200; ++k) {
        const Vec9 off = error_sample(machine.geometry, machine.neutral, machine.tolerances, 1, k);
        CHECK(off.head<3>().norm() <= found.rotation.hi);
        CHECK(off.segment<3>(3).norm() <= found.position.hi);
        CHECK(off.tail<3>().norm() <= found.internal_point.hi);
      }
    }
    PosedRobot exact{random_symmetric_robot(random).geometry, neutral(4.0, 2.2), 1.0, {}, {}, {}};
    CHECK(error_over_poses(exact, {}).position.hi == 0.0);
  }

  TEST_CASE("a pose that is listed beside a region does not hide a worse one in it") {
    PosedRobot machine{Geometry::hexagonal(0.0, 6.0, 3.0, 0.0), neutral(5.0, 3.0), 1.0, {}, {}, {}};
    machine.tolerances.legs.setConstant(1e-5);
    Region region;
    region.shape = Region::Shape::ball;
    region.size = {1.0, 0.0, 0.0};
    machine.region.push_back(region);
    machine.poses.resize(1, machine.neutral);
    double there = 0.0;
    Random random(6);
    for (int n = 0; n < 1000; ++n) {
      Configuration inside = machine.neutral;
      const Vec3 shift = 0.999 * random.matrix<Vec3>().normalized();
      inside.position += shift;
      inside.internal_point += shift;
      const double here = error_bounds(machine.geometry, inside, machine.tolerances).position;
      if (here > there) machine.poses.front() = inside;
      there = std::max(there, here);
    }
    CHECK(error_over_poses(machine, {.gap = 0.5}).position.lo > 1.00002 * there);
  }

  TEST_CASE("boxes are not divided for a limit on which tolerances alone decide") {
    PosedRobot machine{Geometry::hexagonal(0.0, 6.0, 3.0, 0.0), neutral(5.0, 3.0), 1.0, {}, {}, {}};
    Region region;
    region.size = {0.6, 0.6, 0.4};
    region.tilt = 0.15;
    machine.region.push_back(region);
    PoseQuantity angle{.limit_name = "base_cone", .relative = 1e-4};
    const double drawn = pose_extremes(machine, {angle}, {}).front().high;
    machine.tolerances.joints.fill(5e-3);  // more than the search leaves open
    const Extreme far = pose_extremes(machine, {angle}, {}).front();
    angle.limit = drawn;
    const Extreme near = pose_extremes(machine, {angle}, {}).front();
    CHECK(drawn < far.high);
    CHECK(near.boxes == far.boxes);
    CHECK(near.high == far.high);
  }

  TEST_CASE("a leg that vanishes in a region: its ratio has no upper end, and is named") {
    // The lower internal joints are in the way of O, which moves with the platform.
    const Geometry g = Geometry::hexagonal(0.5, 3.0, 1.5, 0.2);
    PosedRobot machine{g, neutral(4.0, 0.01), 1.0, {}, {}, {}};
    machine.neutral.internal_point = g.base_internal()[1] + Vec3(0.0, 0.0, 0.01);
    Region region;
    region.size = {0.1, 0.1, 0.1};
    machine.region.push_back(region);
    const std::vector<Limit> stroke{{.name = "stroke_ratio", .high = 1.5}};
    const LimitsOverPoses found = limits_over_poses(machine, stroke, {}, 1e-6, {});
    const LimitOverPoses& one = found.limits.at(1);
    CHECK(one.part == "r2");
    CHECK(one.at.size() == 2);
    CHECK(one.value.lo > 10.0);
    CHECK(std::isinf(one.value.hi));
    CHECK(one.answer == LimitOverPoses::Answer::violated);
  }

  TEST_CASE("without poses it is the neutral one; an exemption needs a common joint; bad limits are refused") {
    const Geometry g = Geometry::hexagonal(0.0, 3.0, 1.5, 0.0);
    const PosedRobot machine{g, neutral(4.0, 2.2), 1.0, {}, {}, {}};
    const std::vector<Limit> apart{{.name = "leg_clearance", .low = 0.1}, {.name = "height", .high = 4.0}};
    std::array<bool, 21> all;
    all.fill(true);
    const LimitsOverPoses found = limits_over_poses(machine, apart, all, 0.0, {});
    REQUIRE(found.limits.size() == 3);
    CHECK(found.limits[0].name == "no singularity");
    CHECK(found.limits[0].answer == LimitOverPoses::Answer::proved);
    CHECK(found.limits[1].answer == LimitOverPoses::Answer::proved);
    CHECK(found.limits[1].value.lo > 0.1);
    CHECK(found.limits[2].answer == LimitOverPoses::Answer::proved);  // exactly at its limit
    CHECK(limits_over_poses(machine, apart, {}, 0.0, {}).limits[1].answer == LimitOverPoses::Answer::violated);
    CHECK_THROWS_WITH_AS(limits_over_poses(machine, {{.name = "height", .low = 2.0, .high = 1.0}}, {}, 0.0, {}),
                         doctest::Contains("height"), InvalidArgument);
    PosedRobot posed = machine;
    posed.poses.push_back(machine.neutral);
    CHECK_THROWS_AS(pose_extremes(posed, {{.limit_name = "height"}}, {}), InvalidArgument);
    CHECK_THROWS_AS(pose_extremes(posed, {{.limit_name = "leg_length", .item = 9}}, {}), InvalidArgument);
    CHECK_THROWS_AS(pose_extremes(posed, {{.limit_name = "leg_clearance"}}, {}), InvalidArgument);
    CHECK_THROWS_AS(pose_extremes(machine, {{.limit_name = "leg_length"}}, {}), InvalidArgument);
    const Extreme distance = pose_extremes(posed, {{.limit_name = "leg_clearance", .greatest = false}}, {}).front();
    CHECK(distance.low > 0.0);
  }

  TEST_CASE("pairs of legs are exempt that share a joint in every design") {
    Problem apart;
    for (const auto& v : design_family(apart.family).variables()) apart.variables.push_back({v.low, v.high});
    CHECK(std::ranges::none_of(exempt_pairs(apart), [](bool exempt) { return exempt; }));
    Problem general;
    general.family = "symmetric";
    for (const auto& v : design_family(general.family).variables()) general.variables.push_back({v.low, v.high});
    const auto fix = [&](const std::string& name, double value) {
      general.variables[at_index(design_family("symmetric").index(name))] = {value, value};
    };
    fix("base_external_radius", 2.0);
    fix("base_internal_radius", 2.0);
    fix("base_internal_angle", 0.0);
    int count = 0;
    for (const bool exempt : exempt_pairs(general)) count += exempt;
    CHECK(count == 3);  // l1 r1, l2 r2, l3 r3
  }
}
