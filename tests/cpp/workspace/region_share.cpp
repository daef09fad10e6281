/// region_share.hpp: the share of a region within criteria is that of the volume of a ball that a leg cuts off; what is
/// passed is named; exempt pairs.

#include "ninedof/workspace/region_share.hpp"

#include <doctest/doctest.h>

#include "ninedof/robot/legs.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

const std::pair hexagonal{Geometry::hexagonal(0.0, 5.8, 2.9, 0.0), neutral(4.0, 2.4)};  // and its home

Region cube() {
  Region out;
  out.size = Vec3::Constant(0.3);
  return out;
}

}  // namespace

TEST_SUITE("region_share") {
  TEST_CASE("a leg whose base joint is in the middle of a held region keeps a ball of it") {
    Random random(31);
    auto [g, c] = random_robot(random);
    c.rotation.setIdentity();
    Triple base = g.base_external();
    base[0] = c.position + g.platform_external()[0];  // the leg is the shift
    g = Geometry(base, g.base_internal(), g.platform_external(), g.platform_internal());
    Region region;
    region.size = Vec3::Constant(1.0);
    region.shifted = false;
    WorkspaceCriteria criteria;
    criteria.legs = LegLimits{Vec9::Zero(), Vec9::Constant(infinity)};
    criteria.legs->high[0] = 0.8;
    const RegionShare found = region_share(g, c, criteria, region, 20'000);
    CHECK(found.share == doctest::Approx(4.0 / 3.0 * pi * 0.512 / 8.0).epsilon(0.01));
    CHECK(found.poses == 40'000);
    CHECK(found.passed == std::vector<std::string>{"leg_limits"});
    criteria.legs->high[0] = 2.0;
    CHECK(region_share(g, c, criteria, region, 10'000).share == 1.0);
  }

  TEST_CASE("limits of the table, the condition number, the side of home") {
    const auto& [g, home] = hexagonal;
    Region region = cube();
    WorkspaceCriteria criteria;
    criteria.limits = {
        {.name = "base_cone", .high = 1e-3}, {.name = "leg_clearance", .low = 9.0}, {.name = "singularity_free"}};
    criteria.condition_number = 1.0;
    const RegionShare none = region_share(g, home, criteria, region, 500);
    CHECK(none.share == 0.0);
    CHECK(none.passed == std::vector<std::string>{"base_cone", "leg_clearance", "condition_number"});
    region.size.z() = 3.0;  // O, shifted with the platform, comes below the base
    criteria.limits.erase(criteria.limits.begin(), criteria.limits.begin() + 2);
    criteria.condition_number.reset();
    const RegionShare part = region_share(g, home, criteria, region, 20'000);
    CHECK(part.passed == std::vector<std::string>{"singularity_free"});
    CHECK(part.share == doctest::Approx((2.4 + 3.0) / 6.0).epsilon(0.01));
    CHECK(region_share(g, home, {}, region, 10).share == 1.0);
  }

  TEST_CASE("a limit of the condition number has the characteristic length of the criteria") {
    const auto& [g, home] = hexagonal;
    Region region = cube();
    WorkspaceCriteria criteria;
    criteria.limits = {{.name = "fault_tolerant", .high = 20.0}};
    CHECK(region_share(g, home, criteria, region, 200).share == 1.0);
    criteria.characteristic_length = 1e-3;
    CHECK(region_share(g, home, criteria, region, 200).share == 0.0);
  }
}
