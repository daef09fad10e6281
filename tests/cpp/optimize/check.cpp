/// check.hpp: an optimum passes, a design beside it does not; a design is worst over a region where a search says so,
/// and ranges of lengths count; the same on any number of threads.

#include "ninedof/optimize/check.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/studies.hpp"

using namespace ninedof;
using namespace studies;

namespace {

Region box(double half, double tilt) {
  Region out;
  out.size = Vec3::Constant(half);
  out.tilt = tilt;
  return out;
}

Problem at_poses(Problem p, const RegionResult& found) {
  p.objective.poses = found.region.poses;
  return p;
}

}  // namespace

TEST_SUITE("check") {
  TEST_CASE("an optimum is stationary and no step within the limits is better; beside it, both fail") {
    const Problem p = paper_study();
    const Candidate best = optimize(p).candidates.front();
    const OptimumCheck good = check_optimum(p, best.variables, {2000, 3, 1});
    CHECK(good.residual <= 1e-6);
    CHECK(good.active == static_cast<int>(best.active.size()));
    CHECK(good.steps == 2000);
    CHECK(good.better > 100);  // beyond a limit
    CHECK(good.gain <= 1e-8);
    Eigen::VectorXd beside = best.variables;
    beside[hexagonal().index("zp")] += 0.05;
    const OptimumCheck bad = check_optimum(p, beside, {2000, 3, 1});
    CHECK(bad.residual > 1e-3);
    CHECK(bad.gain > 1e-6);
    const double own = condition_number(p, beside);
    CHECK(bad.gain <= 1.0 - best.objective / own + 1e-9);  // nothing is better than the optimum
    const OptimumCheck threads = check_optimum(p, beside, {2000, 3, 4});
    CHECK((threads.gain == bad.gain && threads.better == bad.better));
    CHECK(check_optimum(p, beside, {2000, 4, 1}).gain != bad.gain);
    CHECK(check_optimum(fixed_study({0.0, 6.0, 3.0, 0.0, 5.0, 3.2, 0.0}),
                        Eigen::Vector<double, 7>(0.0, 6.0, 3.0, 0.0, 5.0, 3.2, 0.0), {2000})
              .steps == 0);
    CHECK_THROWS_AS(check_optimum(p, Eigen::VectorXd::Zero(3), {}), InvalidArgument);
  }

  TEST_CASE("a design over its region, over a larger one, and at fewer poses than it needs") {
    Problem p = paper_study();
    p.limits.push_back({.name = "stroke_ratio", .high = 1.4});
    RegionStudySettings few;
    few.starts = cases(4);
    const Region region = box(0.3, 0.1);
    const RegionResult found = optimize_region(p, region, few);
    REQUIRE(found.result.status == Status::optimal);
    const Candidate& best = found.result.candidates.front();
    const Problem there = at_poses(p, found);
    Problem mean = there;
    mean.objective.aggregate = Aggregate::mean_inverse;
    const RegionCheck average = check_region(mean, region, best.variables, {}, 1);
    REQUIRE(average.mean.has_value());
    CHECK(average.mean->value < average.index);
    CHECK(average.mean->standard_error < 0.01);
    CHECK(average.poses > 100'000);
    if (sanitized) return;  // the same search without a mean, as below
    const RegionCheck good = check_region(there, region, best.variables, {}, 1);
    CHECK(good.excess <= 1e-6);
    CHECK(good.index == doctest::Approx(best.objective).epsilon(1e-6));
    CHECK(good.poses > 100'000);
    CHECK_FALSE(good.mean.has_value());
    CHECK(check_region(there, box(0.4, 0.1), best.variables, {}, 1).excess > 1e-3);
  }

  TEST_CASE("with O placed anew, ranges of lengths may be too wide for the limits or too narrow for the poses") {
    Problem p = paper_study();
    p.limits.push_back({.name = "stroke_ratio", .high = 1.3});
    RegionStudySettings one;
    one.starts = 1;
    Region line;
    line.shape = Region::Shape::path;
    line.corners = {Vec3(0.0, 0.0, 0.0), Vec3(0.3, 0.0, 0.0)};
    line.in_zp = line.placed = true;
    line.shifted = false;
    p.objective.index = Index::speed;
    p.objective.condition_limit = 6.0;
    const RegionResult found = optimize_region(p, line, one);
    REQUIRE(found.result.status == Status::optimal);
    REQUIRE(found.region.leg_ranges.has_value());
    const Eigen::VectorXd& x = found.result.candidates.front().variables;
    const Problem there = at_poses(p, found);
    const auto excess = [&](const LegLimits& lengths) { return check_region(there, line, x, lengths, 7).excess; };
    const LegLimits lengths = *found.region.leg_ranges;
    CHECK(excess(lengths) <= 1e-6);
    if (sanitized) return;
    CHECK(excess({lengths.low / 1.01, lengths.high * 1.01}) > 1e-3);
    const Vec9 middle = 0.5 * (lengths.low + lengths.high);
    CHECK(excess({middle, 1.0001 * middle}) > 1e-3);
  }
}
