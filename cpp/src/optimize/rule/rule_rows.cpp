#include "optimize/rule/rule_rows.hpp"

#include <algorithm>
#include <utility>

#include "math/numbers.hpp"

namespace ninedof {

RuleRows::RuleRows(const RuleTask& task, int threads, const Control& control)
    : goal(task.goal.log_index),
      task_(task),
      region_(task.machine.region.front()),
      threads_(threads),
      control_(control) {
  region_.shifted = false;  // shifts of O count from its neutral position
  for (LegRange range : leg_ranges(task.problem)) {
    range.set_zp(zp());
    range.high = Vec9::Constant(0.5 * range.width());
    range.low = -range.high;
    spreads_.push_back({std::move(range), middle_count()});
  }
}

std::vector<Placed> RuleRows::best(const std::vector<Vec6>& at) const {
  std::vector<Placed> out;
  for (const PlacedEnd& end :
       place_in_region(task_.problem, region_, task_.variables, task_.goal, task_.known, at, threads_, control_))
    out.push_back(end.placed);
  return out;
}

std::vector<PlacedRows> RuleRows::at(const std::vector<Placed>& places, const Eigen::VectorXd& middles) const {
  PlacementGoal now{goal, {}};
  for (const Spread& spread : spreads_) {
    now.ranges.push_back(spread.range);
    for (Eigen::Index leg = 0; leg < 9; ++leg) {
      now.ranges.back().low[leg] += middles[spread.middle(leg)];
      now.ranges.back().high[leg] += middles[spread.middle(leg)];
    }
  }
  std::vector<PlacedRows> out = placed_rows(task_.problem, region_, task_.variables, now, places, threads_, control_);
  for (PlacedRows& rows : out)
    for (Eigen::Index row = rows.of_index; row < rows.value.size(); ++row) {
      const Eigen::Index middle = middle_of(rows, row).first;
      const bool common = middle >= 0 && std::ranges::any_of(spreads_, [middle](const Spread& spread) {
                            return !spread.range.spread.each_leg && spread.first == middle;
                          });
      rows.value[row] = common || !rows.by_shift.row(row).isZero(0.0)
                            ? weight * (rows.value[row] + (middle < 0 ? margin : 0.5 * margin))
                            : -infinity;
      rows.by_shift.row(row) *= weight;
    }
  return out;
}

Eigen::Index RuleRows::middle_count() const {
  return spreads_.empty() ? 0 : spreads_.back().middle(8) + 1;
}

Eigen::VectorXd RuleRows::middles(const std::vector<Placed>& places) const {
  PlacementGoal about_zero;
  for (const Spread& spread : spreads_) about_zero.ranges.push_back(spread.range);
  Eigen::VectorXd low = Eigen::VectorXd::Constant(middle_count(), infinity), high = -low;
  for (const PlacedRows& rows :
       placed_rows(task_.problem, region_, task_.variables, about_zero, places, threads_, control_))
    for (std::size_t k = 0; k < spreads_.size(); ++k)
      for (Eigen::Index leg = 0; leg < 9; ++leg) {
        const Eigen::Index above = rows.first_of_range + 18 * static_cast<Eigen::Index>(k) + 2 * leg;
        const double measured = rows.value[above] + spreads_[k].range.high[leg];
        const Eigen::Index middle = spreads_[k].middle(leg);
        low[middle] = std::min(low[middle], measured);
        high[middle] = std::max(high[middle], measured);
      }
  return 0.5 * (low + high);
}

std::pair<Eigen::Index, double> RuleRows::middle_of(const PlacedRows& rows, Eigen::Index row) const {
  const Eigen::Index in_ranges = row - rows.first_of_range;
  if (in_ranges < 0 || in_ranges >= 18 * static_cast<Eigen::Index>(spreads_.size())) return {-1, 0.0};
  return {spreads_[at_index(in_ranges / 18)].middle(in_ranges % 18 / 2), in_ranges % 2 == 0 ? -weight : weight};
}

}  // namespace ninedof
