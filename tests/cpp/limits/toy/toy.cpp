/// A limit that the core does not know (table.cpp) works wherever limits do, without a line of the core: its number is
/// |s - p|, so that every answer has a closed form. The law of rows (limits/law.cpp) is in the same program.

#include <doctest/doctest.h>

#include <algorithm>

#include "limits/table.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/optimize/evaluate.hpp"
#include "ninedof/optimize/optimize.hpp"
#include "ninedof/proof/machine.hpp"
#include "ninedof/sheet/sheet_numbers.hpp"
#include "ninedof/workspace/certified.hpp"
#include "ninedof/workspace/region_share.hpp"
#include "support/studies.hpp"

using namespace ninedof;
using namespace support;

namespace {

const Vec3 apex(0.1, -0.2, 2.0);
const Configuration home{Vec3(0.1, -0.2, 4.0), Mat3::Identity(), apex};

/// Positions within 1.5 of O, which stays where it is; or at least 0.7 from it too.
struct Ball {
  WorkspaceDomain domain;
  InternalPointRule rule{InternalPointRule::Kind::fixed, 0.5, apex};
  WorkspaceCriteria criteria;
  double volume;

  explicit Ball(bool hollow) {
    domain.low = apex - Vec3::Constant(1.7);
    domain.high = apex + Vec3::Constant(1.7);
    criteria.limits = {{.name = "apex_distance", .high = 1.5}};
    if (hollow) criteria.limits.front().low = 0.7;
    volume = 4.0 / 3.0 * pi * (1.5 * 1.5 * 1.5 - (hollow ? 0.7 * 0.7 * 0.7 : 0.0));
  }
};

}  // namespace

TEST_SUITE("toy") {
  TEST_CASE("it is in the tables and has its number") {
    const auto listed = [](const ConstraintInfo& row) { return std::string(row.name) == "apex_distance"; };
    CHECK(std::ranges::any_of(constraint_table(), listed));
    CHECK(std::ranges::any_of(criterion_table(), listed));
    CHECK(limits_of_poses().back() == "apex_distance");
    CHECK(limit_parts("apex_distance") == std::vector<std::string>{"O"});
    double found = 0.0;  // as paths and the viewer have it
    LimitNumbers("apex_distance", published, home, 1.0).at({Vec3(1.0, 2.0, 3.0), Mat3::Identity(), apex}, &found);
    CHECK(found == doctest::Approx((Vec3(1.0, 2.0, 3.0) - apex).norm()).epsilon(1e-15));
  }

  TEST_CASE("evaluate: the margin of the neutral pose, and its slopes") {
    Problem study = studies::paper_study();
    study.limits = {{.name = "apex_distance", .low = 0.3, .of = Unit::zp}};
    Eigen::VectorXd x(7);
    x << 0.1, 5.8, 2.9, 0.1, 4.1, 2.1, 0.0;  // zp and zs are the fifth and the sixth
    const Evaluation e = evaluate(study, x);
    REQUIRE(e.margins.size() == 1);
    CHECK(e.margins[0].name == "apex_distance");
    CHECK(e.margins[0].value == doctest::Approx((1.0 - 2.1 / 4.1) / 0.3 - 1.0).epsilon(1e-14));
    CHECK(e.margins[0].gradient[4] == doctest::Approx(2.1 / (4.1 * 4.1) / 0.3).epsilon(1e-12));
    CHECK(e.margins[0].gradient[5] == doctest::Approx(-1.0 / 4.1 / 0.3).epsilon(1e-12));
  }

  TEST_CASE("optimize: an optimum on the limit") {
    Problem study = studies::paper_study();
    const Settings settings{.starts = 8, .threads = 1};
    const Eigen::VectorXd free = optimize(study, settings).candidates.front().variables;
    const double limit = 0.8 * (free[4] - free[5]);
    study.limits.push_back({.name = "apex_distance", .high = limit});
    const Result result = optimize(study, settings);
    REQUIRE(result.status == Status::optimal);
    const Candidate& best = result.candidates.front();
    CHECK(best.variables[4] - best.variables[5] == doctest::Approx(limit).epsilon(1e-9));
    CHECK(std::ranges::count(best.active, "apex_distance") == 1);
    CHECK(best.prices.at("apex_distance") > 0.0);
  }

  TEST_CASE("sheet: its number at a pose, and both of its ends over poses") {
    const SheetNumbers sheet({.geometry = published, .neutral = home, .limits = {{.name = "apex_distance"}}});
    REQUIRE(sheet.groups().size() == 1);
    const SheetGroup& group = sheet.groups().front();
    CHECK(group.name == "apex_distance");
    REQUIRE(group.size == 1);
    CHECK(group.worst == WorstEnd::both);
    double found = 0.0;
    sheet.evaluate(0, {Vec3(1.0, 2.0, 3.0), Mat3::Identity(), apex}, &found);
    CHECK(found == doctest::Approx((Vec3(1.0, 2.0, 3.0) - apex).norm()).epsilon(1e-15));
  }

  TEST_CASE("share of a region: a ball of a cube, and what is passed") {
    Region cube;
    cube.size = Vec3::Constant(1.0);
    cube.shifted = false;
    WorkspaceCriteria criteria;
    criteria.limits = {{.name = "apex_distance", .high = 0.8}};
    const Configuration in_o{apex, Mat3::Identity(), apex};
    const RegionShare found = region_share(published, in_o, criteria, cube, 20'000);
    CHECK(found.share == doctest::Approx(4.0 / 3.0 * pi * 0.512 / 8.0).epsilon(0.01));
    CHECK(found.passed == std::vector<std::string>{"apex_distance"});
  }

  TEST_CASE("workspace: a ball, or a shell, with the new limit as its boundary") {
    for (const bool hollow : {false, true}) {
      const Ball ball(hollow);
      const WorkspaceMap map = workspace(published, ball.domain, ball.rule, ball.criteria, {}, home);
      CHECK(std::abs(map.volume - ball.volume) <= map.error);
      CHECK(map.error < 0.01 * ball.volume);
      const auto number = std::ranges::find(limit_names(), "apex_distance O") - limit_names().begin();
      REQUIRE(number < std::ssize(limit_names()));
      CHECK(map.limit_area[static_cast<std::size_t>(number)] == map.boundary_area);
      CHECK(map.boundary_area == doctest::Approx(4.0 * pi * (2.25 + (hollow ? 0.49 : 0.0))).epsilon(1e-2));
    }
  }

  TEST_CASE("certified workspace: the volume is between its bounds") {
    for (const bool hollow : {false, true}) {
      const Ball ball(hollow);
      const CertifySettings settings{.gap = 0.02, .seconds = 600.0, .threads = 1};
      const CertifiedWorkspace found =
          certified_workspace(published, ball.domain, ball.rule, ball.criteria, settings, home);
      CHECK(found.end == CertifiedWorkspace::End::gap);
      CHECK(found.volume.low <= ball.volume);
      CHECK(found.volume.high >= ball.volume);
    }
  }

  TEST_CASE("certify: the worst value over a region, and the answer") {
    PosedRobot machine{published, home, 1.0, {{}}, {}, {}};
    machine.region.front().size = Vec3(0.3, 0.2, 0.1);
    machine.region.front().shifted = false;
    const double most = (home.position - apex + Vec3(0.3, 0.2, 0.1)).norm(), least = 2.0 - 0.1;
    const auto answers = [&](double factor) {
      const LimitsOverPoses found = limits_over_poses(
          machine, {{.name = "apex_distance", .low = least / factor, .high = most * factor}}, {}, 0.0, {.threads = 1});
      REQUIRE(found.limits.size() == 3);
      const LimitOverPoses &low = found.limits[1], &high = found.limits[2];
      CHECK(low.name == "apex_distance");
      CHECK(high.part == "O");
      CHECK(contains(low.value, least));
      CHECK(contains(high.value, most));
      CHECK(width(high.value) < 1e-4 * most);
      return std::pair{low.answer, high.answer};
    };
    using enum LimitOverPoses::Answer;
    CHECK(answers(1.001) == std::pair{proved, proved});
    CHECK(answers(0.999) == std::pair{violated, violated});
  }
}
