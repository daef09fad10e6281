/// Problem::tool: rows of the solver, O between the plates among them, against differences; a tool on the axis in the
/// closed form against the general path.

#include <doctest/doctest.h>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/optimize/evaluate.hpp"
#include "optimize/minimax/design_evaluation.hpp"
#include "support/designs.hpp"

using namespace ninedof;
using namespace designs;

namespace {

Problem study(const std::string& family, const Tool& tool) {
  Problem p;
  p.family = family;
  for (const auto& v : design_family(family).variables()) {
    const bool length = v.kind == VariableKind::length;
    p.variables.push_back(length ? Bounds{0.0, 90.0} : Bounds{-20.0, 20.0});
  }
  p.limits = {{"leg_length", 0.5, 6.0}, {.name = "platform_cone", .high = 1.0, .axis = {0.1, -0.2, -1.0}}};
  p.objective.poses = {{.position = {0.1, 0.05, -0.04}, .rotation = {0.05, -0.12, 0.1}, .in_zp = true},
                       {.position = {0.0, -0.3, 0.0}, .rotation = {0.15, 0.0, -0.05}, .best_internal = true}};
  p.tool = tool;
  return p;
}

}  // namespace

TEST_SUITE("tool") {
  TEST_CASE("rows of the solver against differences, beside the axis and turned") {
    Random random(701);
    for (const std::string& family : families)
      for (const Tool& tool : {Tool{{0.4, -0.3, -1.2}, {0.3, -0.2, 0.5}}, Tool{{0.0, 0.0, 0.7}, {}}}) {
        CAPTURE(family);
        const PreparedProblem p(study(family, tool), 1e4);
        const Eigen::VectorXd y = p.coordinates.coordinates(random_full(p.problem, random));
        DesignEvaluation design, there;
        evaluate_design(p, y, design);
        const auto rows = [&](const Eigen::VectorXd& at) {
          evaluate_design(p, at, there);
          Eigen::VectorXd out(there.margins.size() + 1);
          out << there.margins, there.log_objective;
          return out;
        };
        Rows slopes(design.margins.size() + 1, y.size());
        slopes.topRows(design.margins.size()) = design.margin_gradient;
        Eigen::VectorXd level_slopes;
        p.objective(design.levels, &level_slopes);
        bool between = false;
        for (int k = 0; k < static_cast<int>(p.margins.size()); ++k) between |= p.margin_name(k) == "zp > zs";
        CHECK(between);
        for (Eigen::Index k = 0; k < y.size(); ++k) {
          const Eigen::VectorXd quotient = difference(rows, y, k, 1e-5);
          for (Eigen::Index row = 0; row < design.margins.size(); ++row) {
            CAPTURE(row);
            CHECK(std::abs(slopes(row, k) - quotient[row]) <= 3e-7 * std::max(1.0, std::abs(quotient[row])));
          }
        }
      }
  }

  TEST_CASE("O between the plates is below the plate, wherever the tool is") {
    Random random(702);
    const auto least = [](const PreparedProblem& p, const Eigen::VectorXd& x) {
      DesignEvaluation design;
      evaluate_design(p, p.coordinates.coordinates(x), design);
      double out = infinity;
      for (Eigen::Index k = 0; k < design.margins.size(); ++k)
        if (p.margin_name(static_cast<int>(k)) == "zp > zs") out = std::min(out, design.margins[k]);
      return out;
    };
    // Without turns shifts move plate and tool alike.
    Problem plain = study("symmetric", {{0.4, -0.3, -1.2}, {0.3, -0.2, 0.5}}), bare = study("symmetric", {});
    for (Problem* p : {&plain, &bare})
      for (Pose& pose : p->objective.poses) pose.rotation.setZero();
    const PreparedProblem a(plain, 1e4), b(bare, 1e4);
    for (int n = 0; n < cases(20); ++n) {
      const Eigen::VectorXd x = random_full(plain, random);
      CHECK(least(a, x) == doctest::Approx(least(b, x)).epsilon(1e-12));
    }
  }

  TEST_CASE("the closed form with a tool on the axis against the general path") {
    Random random(703);
    for (const std::string& family : families) {
      if (!design_family(family).symmetric()) continue;
      for (int n = 0; n < cases(20); ++n) {
        Problem p = study(family, {{0.0, 0.0, random.uniform(-2.0, 2.0)}, {0.1, -0.2, 0.3}});
        p.limits.clear();
        p.objective.poses.clear();
        const Eigen::VectorXd x = random_full(p, random);
        const double general = condition_number(geometry(p, x), configurations(p, x).front(), 1.0);
        CHECK(evaluate(p, x).condition_number == doctest::Approx(general).epsilon(1e-9));
      }
    }
  }
}
