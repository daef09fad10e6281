/// region_search.hpp: derivatives of every row by the coordinates of a pose in a region against difference quotients,
/// ends never better than a dense sample, the same on any number of threads and from known poses.

#include "ninedof/optimize/region_search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "math/numbers.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/optimize/evaluate.hpp"
#include "optimize/minimax/design_evaluation.hpp"
#include "support/designs.hpp"
#include "support/hand.hpp"
#include "support/regions.hpp"

using namespace ninedof;
using namespace designs;
using namespace regions;

namespace {

Region region_of(int n) {
  Region out = regions::region_of(shapes[at_index(n % 4)]);
  if (n % 3 == 0) out.tilt = 0.0;
  if (n % 5 == 1) out.yaw = 0.0;
  out.shifted = n % 2 == 0;
  out.in_zp = n % 3 == 1;
  return out;
}

Problem study(const std::string& family, std::vector<Limit> limits) {
  Problem p;
  p.family = family;
  for (const auto& v : design_family(family).variables()) p.variables.push_back({v.low, v.high});
  p.limits = std::move(limits);
  return p;
}

/// One design at one pose of a region; the slopes of all its poses wanted.
struct AtPose {
  AtPose(const PreparedProblem& problem, const Eigen::VectorXd& y, const Region& region, const Vec6& at, bool slopes)
      : p(problem) {
    std::vector<PoseSpec> specs = p.pose_specs;
    for (std::size_t k = 1; k < specs.size(); ++k) {
      specs[k].pose = region.pose(at);
      if (slopes) specs[k].slopes = region.slopes(at);
    }
    p.set_state(y, design.state);
    design.state.set_poses(specs);
  }
  const PreparedProblem& p;
  DesignEvaluation design;
};

Problem one_pose(Problem p) {
  p.objective.poses = {{.position = Vec3(1.0, 0.5, 0.0)}};
  return p;
}

/// Of all margins and the index, by differences of the whole evaluation.
Eigen::MatrixXd quotients(const PreparedProblem& p, const Region& region, const Vec6& at) {
  constexpr double h = 1e-4;
  const auto all = [&](const Vec6& where) {
    AtPose one(p, {}, region, where, false);
    evaluate_rows(p, one.design);
    Eigen::VectorXd out(one.design.margins.size() + 1);
    out << one.design.margins, one.design.log_objective;
    return out;
  };
  Eigen::MatrixXd out(static_cast<Eigen::Index>(p.margins.size()) + 1, 6);
  for (int k = 0; k < 6; ++k) {
    const Vec6 e = h * Vec6::Unit(k);
    out.col(k) = (8.0 * (all(at + e) - all(at - e)) - (all(at + 2.0 * e) - all(at - 2.0 * e))) / (12.0 * h);
  }
  return out;
}

Eigen::VectorXd twisted_design(const Problem& p, Random& random) {
  Eigen::VectorXd out = random_design(p.family, random);
  const int twist = design_family(p.family).index("theta_z");
  if (twist >= 0) out[twist] = random.uniform(-0.5, 0.5);
  return out;
}

/// The least shown margin of every row, and the greatest index.
std::map<std::pair<std::string, int>, double> least_of(const RegionWorst& worst) {
  std::map<std::pair<std::string, int>, double> out;
  const auto take = [&](const std::string& name, int row, double value) {
    const auto [at, added] = out.try_emplace({name, row}, value);
    at->second = std::min(at->second, value);
  };
  for (const RegionWorst::Limit& limit : worst.limits) take(limit.name, limit.row, limit.margin);
  for (const RegionWorst::Index& index : worst.index) take("index", 0, -index.logarithm);
  return out;
}

bool same_bits(const RegionWorst& a, const RegionWorst& b) {
  const auto same_limit = [](const auto& x, const auto& y) {
    return x.name == y.name && x.row == y.row && x.margin == y.margin && x.at == y.at;
  };
  const auto same_index = [](const auto& x, const auto& y) { return x.logarithm == y.logarithm && x.at == y.at; };
  return a.poses == b.poses && a.longest_at == b.longest_at && a.shortest_at == b.shortest_at &&
         std::ranges::equal(a.limits, b.limits, same_limit) && std::ranges::equal(a.index, b.index, same_index);
}

const std::vector<Limit> many{{.name = "leg_length", .low = 1.0, .high = 5.0},
                              {.name = "leg_clearance", .low = 0.1},
                              {.name = "base_cone", .high = 0.6},
                              {.name = "fault_tolerant", .high = 6.0},
                              {.name = "singularity_free", .low = 0.02, .steps = 2}};

}  // namespace

TEST_SUITE("region_search") {
  TEST_CASE("every row by the coordinates of a pose, against difference quotients") {
    Random random(811);
    int looked_at = 0;
    for (const std::string family : {"general", "hexagonal"})
      for (const ConstraintInfo& row : constraint_table())
        for (int n = 0; n < cases(8); ++n) {
          if (std::string(row.name) == "leg_ratio" && family != "general") break;  // legs of one length: kinks
          CAPTURE(family);
          CAPTURE(std::string(row.name));
          Problem problem = one_pose(study(family, {hand::limit_of(row)}));
          problem.objective.condition_limit = 50.0;
          problem.objective.index =
              std::array{Index::condition_number, Index::speed, Index::frobenius}[at_index(n % 3)];
          const Eigen::VectorXd x = twisted_design(problem, random);
          const Region region = region_of(n);
          Vec6 at = 0.7 * region_sample(region, n + 1, 3);
          if (region.shape == Region::Shape::path) at[0] = n % 8 < 4 ? -0.4 : 0.5;
          const PreparedProblem fixed(problem, x), free(problem);
          AtPose alone(fixed, {}, region, at, true), whole(free, x, region, at, true),
              plain(free, x, region, at, false);
          REQUIRE(alone.design.state.columns() == 6);
          REQUIRE(whole.design.state.columns() == free.coordinates.size() + 6);
          evaluate_rows(free, whole.design);
          evaluate_rows(free, plain.design);
          const Eigen::MatrixXd expected = quotients(fixed, region, at);
          Eigen::RowVectorXd gradient(6);
          for (int k = 0; k < whole.design.margins.size(); ++k) {
            CAPTURE(k);
            const double size = 1.0 + expected.row(k).norm(), value = evaluate_margin(fixed, alone.design, k, gradient);
            CHECK(value == whole.design.margins[k]);
            CAPTURE(value);
            if (!(std::abs(value) < 100.0)) continue;                                // exempt pairs of legs
            if (row.kind == LimitKind::angle && std::abs(value - 1.0) < 0.01) continue;  // a kink: on the axis
            if (value < -1.5 && fixed.margins[at_index(k)].constraint < 0) continue;  // next to a singularity
            if (*row.needs != '\0' && size > 1e3) continue;                          // there forces change too fast
            ++looked_at;
            CHECK((whole.design.margin_gradient.row(k).tail<6>() - gradient).norm() <= 1e-12 * size);
            CHECK(whole.design.margin_gradient.row(k).head(x.size()) == plain.design.margin_gradient.row(k));
            const bool inner_pair = fixed.margins[at_index(k)].constraint < 0 && fixed.margins[at_index(k)].row != 0;
            CHECK((expected.row(k) - gradient).norm() <= (inner_pair ? 1e-4 : 1e-6) * size);
          }
          const double index = evaluate_index(fixed, alone.design, 0, gradient);
          CHECK(index == whole.design.log_objective);
          if (index < 5.0) CHECK((expected.bottomRows<1>() - gradient).norm() <= 1e-6 * (1.0 + gradient.norm()));
        }
    CHECK(looked_at > cases(500));
  }

  TEST_CASE("no pose of a dense sample is worse than the ends") {
    Random random(812);
    for (int n = 0; n < cases(8); ++n) {
      const Problem problem = study("general", many);
      const Eigen::VectorXd x = twisted_design(problem, random);
      const Region region = region_of(n);
      CAPTURE(n);
      const RegionWorst found = search_region(problem, region, x, {4000, 1, 2});
      const auto least = least_of(found);
      const double tightest = std::ranges::min_element(least, {}, [](const auto& e) {
                                return e.first.first == "index" ? infinity : e.second;
                              })->second;
      Problem posed = one_pose(problem);
      Eigen::VectorXd shortest = Eigen::VectorXd::Constant(9, infinity), longest = -shortest;
      const PreparedProblem p(posed, x);
      for (long k = 0; k < cases(20'000); ++k) {
        AtPose one(p, {}, region, region_sample(region, k, 99), false);
        evaluate_rows(p, one.design);
        CHECK(-one.design.log_objective >= least.at({"index", 0}) - 1e-9);
        for (int m = 0; m < one.design.margins.size(); ++m) {
          const double shown = p.shown_margin(m, one.design.margins[m]).value, end = least.at({p.margin_name(m), m});
          if (end < 0.05) CHECK(shown >= end - 1e-9);  // others are samples
          CHECK(shown >= tightest - 1e-9);
        }
        const Vec9& lengths = one.design.state.pose(1).legs.length;
        shortest = shortest.cwiseMin(lengths);
        longest = longest.cwiseMax(lengths);
      }
      for (int leg = 0; leg < 9; ++leg) {
        const AtPose low(p, {}, region, found.shortest_at[at_index(leg)], false);
        const AtPose high(p, {}, region, found.longest_at[at_index(leg)], false);
        CHECK(low.design.state.pose(1).legs.length[leg] <= shortest[leg] + 1e-9);
        CHECK(high.design.state.pose(1).legs.length[leg] >= longest[leg] - 1e-9);
      }
    }
  }

  TEST_CASE("the same bits on any number of threads; ends lie apart, and known poses give no worse ones") {
    Random random(813);
    for (int n = 0; n < cases(4); ++n) {
      const Problem problem = study("general", many);
      const Eigen::VectorXd x = twisted_design(problem, random);
      const Region region = region_of(n);
      const RegionWorst one = search_region(problem, region, x, {2000, 1, 1});
      for (const int threads : {2, 7}) CHECK(same_bits(search_region(problem, region, x, {2000, 1, threads}), one));
      for (const auto& a : one.index)
        for (const auto& b : one.index)
          if (&a != &b) CHECK(((a.at - b.at).cwiseAbs().array() > 1e-7 * region.reach().array()).any());
      RegionSettings few{200, 5, 2};
      for (const auto& end : one.limits) few.known.push_back(end.at);
      for (const auto& end : one.index) few.known.push_back(end.at);
      const auto again = least_of(search_region(problem, region, x, few));
      for (const auto& [row, value] : least_of(one)) CHECK(again.at(row) <= value + 1e-12);
      few.known.clear();
      few.most_starts = 1;
      CHECK(search_region(problem, region, x, few).index.size() == 1);
    }
  }
}
