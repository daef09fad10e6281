/// pose_follower.hpp: rows of the solver at poses that follow the design against differences; a worst that is followed
/// against the worst of another design, found by descent.

#include "optimize/region/pose_follower.hpp"

#include <doctest/doctest.h>

#include "domains/region_descent.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/optimize/region_study.hpp"
#include "support/designs.hpp"
#include "support/regions.hpp"

using namespace ninedof;
using namespace designs;
using namespace regions;

namespace {

Region region_of(Region::Shape shape, int kind) {
  Region out = regions::region_of(shape);
  out.in_zp = kind % 2 == 1;
  out.shifted = kind % 3 != 2;
  return out;
}

Problem study(const std::string& family) {
  Problem p;
  p.family = family;
  for (const auto& v : design_family(family).variables()) {
    const bool length = v.kind == VariableKind::length;
    p.variables.push_back(length ? Bounds{0.0, 90.0} : Bounds{-20.0, 20.0});
  }
  p.limits = {{.name = "leg_length", .low = 0.5, .high = 6.0},
              {.name = "stroke_ratio", .high = 1.5},
              {.name = "base_cone", .high = 0.6},
              {.name = "singularity_free", .low = 0.02, .steps = 3}};
  p.characteristic_length = {.choice = StudyLength::Choice::free, .bounds = {0.1, 10.0}};
  return p;
}

Eigen::VectorXd design_of(const Problem& p, Random& random) {
  const Eigen::VectorXd own = random_design(p.family, random);
  Eigen::VectorXd out(own.size() + 1);
  out << own, random.uniform(0.7, 1.5);
  return out;
}

}  // namespace

TEST_SUITE("pose_follower") {
  TEST_CASE("rows of the solver at poses that follow the design, against differences") {
    Random random(711);
    int kind = 0;
    for (const std::string& family : families)
      for (const Region::Shape shape : shapes) {
        CAPTURE(family);
        CAPTURE(static_cast<int>(shape));
        const Region region = region_of(shape, ++kind);
        Problem posed_study = study(family);
        if (kind % 4 == 0) posed_study.tool = {{0.2, -0.1, 0.4}, {0.1, -0.2, 0.3}};
        for (int k = 0; k < 2; ++k)
          posed_study.objective.poses.push_back(region.pose(region_sample(region, 40 + k, 3)));
        PreparedProblem p(posed_study, 1e4);
        const Eigen::VectorXd x = design_of(study(family), random);
        for (int k = 0; k < 2; ++k) {
          FollowingPose pose{region, region_sample(region, 40 + k, 3), x, {}};
          if (k == 1) pose.at = region.nearest(2.0 * pose.at);  // at the edge
          pose.by_variables.resize(6, x.size());
          for (double& by : pose.by_variables.reshaped()) by = 0.1 * random.normal();
          REQUIRE(p.follow(k, std::make_shared<const FollowingPose>(std::move(pose))));
        }
        const Eigen::VectorXd y = p.coordinates.coordinates(1.01 * x);
        DesignEvaluation design, there;
        evaluate_design(p, y, design);
        const auto rows = [&](const Eigen::VectorXd& at) {
          evaluate_design(p, at, there);
          Eigen::VectorXd out(there.margins.size() + there.objective_rows.size());
          out << there.margins, there.objective_rows;
          return out;
        };
        constexpr double h = 3e-6;  // short of a corner of the path
        for (Eigen::Index v = 0; v < y.size(); ++v) {
          const Eigen::VectorXd e = h * Eigen::VectorXd::Unit(y.size(), v);
          const Eigen::VectorXd quotient = (rows(y + e) - rows(y - e)) / (2.0 * h);
          Eigen::VectorXd slopes(quotient.size());
          slopes << design.margin_gradient.col(v), design.row_gradient.col(v);
          CHECK((slopes - quotient).cwiseAbs().maxCoeff() < 1e-6 * (1.0 + quotient.cwiseAbs().maxCoeff()));
        }
      }
  }

  TEST_CASE("a design without free variables is looked over, and no more") {
    const Region region = region_of(Region::Shape::box);
    Problem fixed = study("symmetric");
    Random random(713);
    const Eigen::VectorXd x = design_of(fixed, random);
    for (std::size_t k = 0; k < fixed.variables.size(); ++k) {
      const double value = x[static_cast<Eigen::Index>(k)];
      fixed.variables[k] = {value, value};
    }
    fixed.characteristic_length = {};
    const RegionResult found = optimize_region(fixed, region, {{.starts = 1}});
    REQUIRE(found.result.candidates.size() == 1);
    CHECK(relative_error(found.result.candidates.front().variables[0], x[0]) < 1e-12);
    CHECK(found.region.looked_at > 0);
    CHECK(found.region.rounds > 1);  // what joins in the first is solved with in the next
  }

  TEST_CASE("a worst that is followed is nearly that of a design beside it") {
    Random random(712);
    int moved = 0, worse = 0;
    for (int n = 0; n < cases(24); ++n) {
      const Region region = region_of(shapes[at_index(n % 4)], n);
      const Problem p = study(families[at_index(n) % families.size()]);
      const Eigen::VectorXd x = design_of(p, random);
      Eigen::VectorXd beside = x;
      for (double& value : beside) value *= 1.0 + 2e-3 * random.normal();
      DesignAtPoses here(p, region, x), there(p, region, beside);
      PoseFollower follower(p, region, x);
      const int numbers = here.groups().front();
      for (int number = 0; number < numbers; ++number) {
        if (!here.smooth(0, number)) continue;
        const NumberPlace place{0, number, numbers};
        Vec6 unused;
        MetNumber met{0.0, region_sample(region, 100 + n, 5)};
        met.value = here.slopes(0, number, met.at, unused);
        descend(here, region, place, 1e-9, {}, met);
        const auto pose = follower.following({met.at, number});
        if (!pose) continue;
        MetNumber end{there.slopes(0, number, pose->at_design(beside), unused), pose->at_design(beside)};
        const double followed = end.value, stayed = there.slopes(0, number, met.at, unused);
        descend(there, region, place, 1e-9, {}, end);
        if (stayed - end.value < 1e-8) continue;
        ++moved;
        worse += followed - end.value > 0.2 * (stayed - end.value);
      }
    }
    CHECK(moved > 50);
    CHECK(worse * 20 <= moved);  // kinks, and worsts that meet an edge on the way
  }
}
