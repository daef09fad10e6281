/// design_evaluation.hpp: what a selection evaluates, alone and with the others after it, against all rows at once.

#include "optimize/minimax/design_evaluation.hpp"

#include <doctest/doctest.h>

#include "support/designs.hpp"

using namespace ninedof;
using namespace designs;

namespace {

/// A study at five poses off the axis and one on it, with every kind of row.
Problem study(Index index, Aggregate aggregate) {
  Problem p;
  p.family = "symmetric";
  for (const auto& v : design_family(p.family).variables())
    p.variables.push_back(v.kind == VariableKind::length ? Bounds{0.2, 9.0} : Bounds{-0.5, 0.5});
  p.limits = {{.name = "leg_ratio", .high = 4.0},
              {.name = "stroke_ratio", .high = 1.5},
              {.name = "platform_cone", .high = 0.6},
              {.name = "leg_clearance", .low = 0.05},
              {.name = "singularity_free", .low = 0.02, .steps = 2}};
  p.objective.index = index;
  p.objective.aggregate = aggregate;
  p.objective.condition_limit = 9.0;
  p.objective.poses = {{}};
  for (int k = 0; k < 5; ++k) {
    p.objective.poses.emplace_back();
    p.objective.poses.back().position = 0.1 * Vec3(k - 2.0, 1.0, 0.5 * k);
    p.objective.poses.back().rotation = 0.05 * Vec3(1.0, k - 1.0, 0.3);
  }
  return p;
}

}  // namespace

TEST_SUITE("design_evaluation") {
  TEST_CASE("selected rows alone are those of all rows, and the others come after them") {
    for (const Index index : {Index::condition_number, Index::speed, Index::frobenius})
      for (const Aggregate aggregate : {Aggregate::worst, Aggregate::mean_inverse}) {
        const PreparedProblem p(study(index, aggregate), 10.0);
        RowSelection some = selection_of(p, {0, static_cast<int>(p.row_levels.size()) - 1},
                                         {1, static_cast<int>(p.margins.size()) - 1});
        some.alone = true;
        for (int n = 0; n < 8; ++n) {
          DesignEvaluation every, part;
          // Another design first: nothing of it may be left.
          evaluate_design(p, p.with_auxiliary(p.coordinates.start(n + 20, 3)), part);
          const Eigen::VectorXd y = p.with_auxiliary(p.coordinates.start(n, 3));
          evaluate_design(p, y, every);
          evaluate_design(p, y, part, &some);
          const auto near = [](const auto& a, const auto& b) { return (a - b).norm() <= 1e-9 * (1.0 + b.norm()); };
          for (const int k : some.row_levels) {
            const int row = p.row_levels[at_index(k)].row;
            CHECK(part.objective_rows[row] == doctest::Approx(every.objective_rows[row]).epsilon(1e-12));
            CHECK(near(part.row_gradient.row(row), every.row_gradient.row(row)));
          }
          for (const int k : some.margins) {
            CHECK(part.margins[k] == doctest::Approx(every.margins[k]).epsilon(1e-12));
            CHECK(near(part.margin_gradient.row(k), every.margin_gradient.row(k)));
          }
          evaluate_others(p, part, some);
          CHECK((part.objective_rows - every.objective_rows).cwiseAbs().maxCoeff() <= 1e-12);
          CHECK((part.margins - every.margins).cwiseAbs().maxCoeff() <= 1e-11);
          CHECK(part.log_objective == doctest::Approx(every.log_objective).epsilon(1e-12));
        }
      }
  }
}
