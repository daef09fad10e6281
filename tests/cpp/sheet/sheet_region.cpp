/// sheet_numbers.hpp, sheet_region.hpp: every number against the function that it is of; over a region no pose of
/// another sample is worse, and each extreme is met at one of the poses that are given.

#include "ninedof/sheet/sheet_region.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

SheetQuestion everything(const Geometry& g, const Configuration& neutral) {
  SheetQuestion q{.geometry = g, .neutral = neutral};
  q.characteristic_length = 1.3;
  q.limits = {{.name = "base_cone"}, {.name = "platform_cone", .axis = {0, 0.2, -1}}, {.name = "leg_clearance"}};
  q.exempt[4] = true;
  q.motion = PlatformMotion{InternalMotion::carried, 1.5, 0.4, TwistMotion{Vec6::Ones(), Vec6::Ones()}};
  q.loads = {{Vec3(1, 2, 3), Vec3(0, 0, -5), Vec3::Zero()}, {}};
  q.weight = Weight{2.0, Vec3(0.1, 0, 0.2), Vec3(0, 0, -9.81)};
  q.errors = Tolerances{Vec9::Constant(1e-3), {}};
  q.leg_stiffness = Vec9::Constant(1e4);
  return q;
}

/// The numbers of all groups at a pose.
std::vector<double> numbers(const SheetNumbers& sheet, const Configuration& c) {
  std::vector<double> out;
  for (std::size_t k = 0; k < sheet.groups().size(); ++k) {
    out.resize(out.size() + at_index(sheet.groups()[k].size));
    sheet.evaluate(k, c, &*out.end() - sheet.groups()[k].size);
  }
  return out;
}

Region box() {
  Region out;
  out.size = Vec3(0.3, 0.2, 0.25);
  out.tilt = 0.2;
  return out;
}

}  // namespace

TEST_SUITE("sheet_region") {
  TEST_CASE("numbers are those of their functions") {
    Random random(21);
    const auto [g, c] = random_robot(random);
    const Configuration home = plus(c, 0.05 * random.matrix<Vec9>());
    const SheetQuestion q = everything(g, home);
    const SheetNumbers sheet(q);
    std::size_t forces = 0;
    std::vector<std::string> names;
    for (const SheetGroup& group : sheet.groups()) names.push_back(group.name);
    CHECK(names == std::vector<std::string>{"base_cone", "platform_cone", "leg_clearance", "speed", "acceleration",
                                            "twist_speed", "twist_acceleration", "force", "power", "error", "stiffness",
                                            "condition_number"});
    for (std::size_t k = 0; k < names.size(); ++k)
      if (names[k] == "force") forces = k;
    std::vector<double> found(18);
    sheet.evaluate(forces, c, found.data());
    const Load own = q.weight->at(c.rotation);
    CHECK((Vec9::Map(found.data() + 9) - leg_forces(g, c, own).forces).norm() < 1e-12);
    const Load both{q.loads[0].moment + own.moment, q.loads[0].force + own.force, Vec3::Zero()};
    CHECK((Vec9::Map(found.data()) - leg_forces(g, c, both).forces).norm() < 1e-12);
    const std::vector<double> all = numbers(sheet, c);
    CHECK(all.back() == condition_number(g, c, 1.3));
    CHECK(all[12 + 4] == infinity);
    CHECK(all[12 + 5] < 100.0);
    const ErrorBounds bounds = error_bounds(g, c, *q.errors);
    CHECK(all[all.size() - 6] == bounds.position);
    CHECK(all[all.size() - 5] == bounds.rotation);
    CHECK(all[all.size() - 3] == least_stiffness(g, c, *q.leg_stiffness).shift);
    SheetQuestion failing = q;
    failing.locked = {{0, -1}};
    const std::vector<double> more = numbers(SheetNumbers(failing), c);
    REQUIRE(more.size() == all.size() + 10);
    CHECK(more[all.size() + 4] == jacobian(g, c, 1.3).col(4).norm());
    // Alone, it asks for nothing.
    CHECK(SheetNumbers({.geometry = g, .neutral = home}).groups().empty());
  }

  TEST_CASE("no pose of another sample is worse") {
    Random random(22);
    for (int n = 0; n < cases(3); ++n) {
      const auto [g, c] = random_robot(random);
      const SheetQuestion q = everything(g, c);
      const Region region = box();
      const SheetNumbers sheet(q);
      const SheetRegion found = sheet_over_region(q, region, {2000, 0, 2});
      CHECK(found.poses > 2000);
      std::vector<double> low(numbers(sheet, c)), high(low);
      for (const Vec6& at : found.worst) {
        const std::vector<double> here = numbers(sheet, region.configuration(at, c));
        for (std::size_t k = 0; k < here.size(); ++k) {
          low[k] = std::min(low[k], here[k]);
          high[k] = std::max(high[k], here[k]);
        }
      }
      double mean = 0.0;
      const auto [shortest, longest] = leg_lengths_over(g, c, region, {2000, 0, 2});
      for (long i = 0; i < 3000; ++i) {
        const Configuration pose = region.configuration(region_sample(region, i, 99), c);
        const std::vector<double> here = numbers(sheet, pose);
        std::size_t k = 0;
        for (const SheetGroup& group : sheet.groups())
          for (int j = 0; j < group.size; ++j, ++k) {
            if (group.worst != WorstEnd::least) CHECK(here[k] <= high[k] + 1e-9 * std::abs(high[k]) + 1e-12);
            if (group.worst != WorstEnd::greatest && here[k] < infinity)
              CHECK(here[k] >= low[k] - 1e-9 * std::abs(low[k]) - 1e-12);
          }
        const Vec9 lengths = leg_lengths(g, pose);
        CHECK((lengths - longest).maxCoeff() < 1e-9);
        CHECK((shortest - lengths).maxCoeff() < 1e-9);
        mean += condition_number(g, region.configuration(even_sample(region, i, 5), c), 1.3) / 3000.0;
      }
      CHECK(std::abs(mean - found.mean) < 6.0 * (found.mean_error + 1e-3 * mean));
    }
  }

  TEST_CASE("with O placed by each thread, external legs do not ask for it and internal ones follow it") {
    Random random(23);
    const auto [g, c] = random_robot(random);
    const Region region = box();
    SheetQuestion q{.geometry = g, .neutral = c};
    q.characteristic_length = 1.3;
    const auto held = [&, g = g, c = c] {
      return [&region, c](const Vec6& at) {
        Configuration out = region.configuration(at, c);
        out.internal_point = c.internal_point;
        return out;
      };
    };
    const SheetRegion found = sheet_over_region(q, region, {1000, 0, 2}, held);
    Region still = region;
    still.shifted = false;
    const auto [shortest, longest] = leg_lengths_over(g, c, still, {1000, 0, 1});
    Vec9 low = leg_lengths(g, c), high = low;
    for (const Vec6& at : found.worst) {
      const Vec9 here = leg_lengths(g, held()(at));
      low = low.cwiseMin(here);
      high = high.cwiseMax(here);
    }
    CHECK((low - shortest).cwiseAbs().maxCoeff() < 1e-6);
    CHECK((high - longest).cwiseAbs().maxCoeff() < 1e-6);
  }
}
