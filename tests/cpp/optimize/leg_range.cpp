/// leg_range.hpp against what a range promises: it holds the lengths, and legs that stay in it keep the limit.

#include "ninedof/optimize/leg_range.hpp"

#include <doctest/doctest.h>

#include "support/studies.hpp"

using namespace ninedof;
using namespace support;

namespace {

/// Three poses: leg k is longest in the last and shortest in the first.
std::vector<Vec9> some_lengths() {
  std::vector<Vec9> out(3);
  for (int k = 0; k < 9; ++k)
    for (int pose = 0; pose < 3; ++pose) out[static_cast<std::size_t>(pose)][k] = 1.0 + 0.1 * k + 0.05 * pose;
  return out;
}

Problem limited(std::vector<Limit> limits) {
  Problem problem = studies::paper_study();
  problem.limits = std::move(limits);
  return problem;
}

}  // namespace

TEST_SUITE("leg_range") {
  TEST_CASE("ranges leave what the limit leaves, evenly at both ends") {
    const Problem problem = limited({{.name = "stroke", .high = 0.2, .of = Unit::zp},
                                     {.name = "stroke_ratio", .high = 1.5},
                                     {.name = "leg_ratio", .high = 3.0}});
    const double zp = 2.5;
    const std::vector<LegRange> ranges = leg_ranges(problem, zp, some_lengths());
    REQUIRE(ranges.size() == 3);
    for (Eigen::Index leg = 0; leg < 9; ++leg) {
      const double shortest = some_lengths()[0][leg], longest = some_lengths()[2][leg];
      const auto ends = [&](std::size_t r) {
        return std::pair(ranges[r].length(ranges[r].low[leg]), ranges[r].length(ranges[r].high[leg]));
      };
      const auto [low, high] = ends(0);
      CHECK(high - low == doctest::Approx(0.5));
      CHECK(shortest - low == doctest::Approx(high - longest));
      const auto [least, most] = ends(1);
      CHECK(most / least == doctest::Approx(1.5));
      CHECK(shortest / least == doctest::Approx(most / longest));
      const auto [smallest, greatest] = ends(2);
      CHECK(greatest / smallest == doctest::Approx(3.0));
      CHECK(1.0 / smallest == doctest::Approx(greatest / 1.9));
    }
    CHECK((ranges[0].in_zp && !ranges[0].spread.ratio && ranges[0].spread.each_leg));
    CHECK((ranges[2].spread.ratio && !ranges[2].spread.each_leg));
  }

  TEST_CASE("the common range is the narrowest of all and of the limits of legs") {
    const Problem problem = limited({{.name = "stroke", .high = 0.4}, {.name = "stroke_ratio", .high = 1.5}});
    const std::vector<LegRange> ranges = leg_ranges(problem, 1.0, some_lengths());
    LegLimits limits;
    limits.low[0] = 0.99;
    limits.high[8] = 1.95;
    const LegLimits common = common_range(ranges, limits);
    CHECK((common.low[0] == 0.99 && common.high[8] == 1.95));
    for (Eigen::Index leg = 1; leg < 8; ++leg) {
      const double shortest = some_lengths()[0][leg], longest = some_lengths()[2][leg];
      const double ratio = std::sqrt(1.5 * shortest / longest);
      CHECK(common.low[leg] == doctest::Approx(std::max(0.5 * (shortest + longest) - 0.2, shortest / ratio)));
      CHECK(common.high[leg] == doctest::Approx(std::min(0.5 * (shortest + longest) + 0.2, longest * ratio)));
    }
    CHECK((common_range({}, limits).low == limits.low && common_range({}, limits).high == limits.high));
    const LegLimits again = common_range({range_of(common, 3.0)}, {});
    CHECK((again.low.isApprox(common.low, 1e-14) && again.high.isApprox(common.high, 1e-14)));
  }

  TEST_CASE("limits that compare no poses, are open or hold at the neutral pose have no range") {
    const Problem problem = limited({{.name = "leg_length", .low = 1.0, .high = 5.0},
                                     {.name = "radius_ratio", .high = 2.0},
                                     {.name = "leg_ratio", .low = 1.1},
                                     {.name = "leg_ratio", .high = 3.0, .at = LimitAt::neutral},
                                     {.name = "stroke", .high = 0.4}});
    REQUIRE(leg_ranges(problem).size() == 1);
    CHECK(leg_ranges(problem)[0].limit == "stroke");
    CHECK(refuses("lengths", [&] { leg_ranges(problem, 1.0, {}); }));
  }
}
