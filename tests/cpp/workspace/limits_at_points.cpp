/// Margins at points of a chart: those of the rows at each pose, in a stack as one by one.

#include "workspace/criteria/limits_at_points.hpp"

#include <doctest/doctest.h>

#include "limits/law_boxes.hpp"

using namespace law;

TEST_SUITE("limits_at_points") {
  TEST_CASE("points have the margins of the rows, and a stack is its points one by one") {
    Random random(3);
    for (int n = 0; n < 4; ++n) {
      const Case one(random, n);
      WorkspaceDomain domain;
      domain.low = one.here.position - Vec3::Constant(0.3);
      domain.high = one.here.position + Vec3::Constant(0.3);
      domain.rotations = {one.here.rotation};
      const InternalPointRule rule{InternalPointRule::Kind::fixed, 0.5, one.here.internal_point};
      std::vector<Vec3> points;
      for (int k = 0; k < 13; ++k) points.push_back(one.here.position + 0.1 * random.matrix<Vec3>());
      for (const LimitRow& row : limit_rows()) {
        if (!row.is_criterion() || row.pose == nullptr) continue;
        CAPTURE(std::string(row.info.name));
        const bool least = row.info.sides == LimitSides::only_low;
        Limit limit;
        limit.name = row.info.name;
        (least ? limit.low : limit.high) = least ? 0.01 : 1.2;
        limit.duty = one.options.duty;
        if (row.info.kind == LimitKind::angle) limit.axis = one.options.axis;
        WorkspaceCriteria criteria;
        criteria.limits = {limit};
        const LimitsAtPoints limits(one.g, domain, rule, criteria, one.home);
        std::vector<PointMargins> stack(points.size());
        limits.evaluate(points.data(), std::ssize(points), stack.data(), {});
        for (std::size_t k = 0; k < points.size(); ++k) {
          PointMargins alone;
          limits.evaluate(&points[k], 1, &alone, {});
          CHECK(alone.margin == stack[k].margin);
          Case there = one;
          there.here.position = points[k];
          there.options = limit.options();
          double worst = infinity;
          for (int item = 0; item < row.pose->items; ++item)
            worst = std::min(worst, cell_margin(row.info.kind, least ? Side::low : Side::high, least ? 0.01 : 1.2,
                                                number_of(*row.pose, there, item)));
          const double found = *std::min_element(alone.margin.begin(), alone.margin.begin() + limits.groups());
          CHECK((found == worst || std::abs(found - worst) <= 1e-12 * (1.0 + std::abs(worst))));  // infinite at rest
          CHECK(limits.least(alone, false) == found / (row.info.kind == LimitKind::length ? limits.size() : 1.0));
        }
      }
    }
  }
}
