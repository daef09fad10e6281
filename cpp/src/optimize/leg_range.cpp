#include "ninedof/optimize/leg_range.hpp"

#include "limits/table.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {

void LegRange::set_zp(double zp) {
  if (!spread.ratio) size = most * (in_zp ? zp : 1.0);
}

void LegRange::surround(const Vec9& shortest, const Vec9& longest) {
  for (Eigen::Index leg = 0; leg < 9; ++leg) {
    const double least = measured(spread.each_leg ? shortest[leg] : shortest.minCoeff());
    const double greatest = measured(spread.each_leg ? longest[leg] : longest.maxCoeff());
    low[leg] = 0.5 * (least + greatest - width());
    high[leg] = low[leg] + width();
  }
}

LegRange range_of(const LegLimits& lengths, double size) {
  LegRange out;
  out.size = size;
  const auto measured = [&](double length) { return out.measured(length); };
  out.low = lengths.low.unaryExpr(measured);
  out.high = lengths.high.unaryExpr(measured);
  return out;
}

std::vector<LegRange> leg_ranges(const Problem& problem) {
  std::vector<LegRange> out;
  for (const Limit& limit : problem.limits) {
    const SpreadRow* row = limit_row(limit.name).spread;
    if (row == nullptr || limit.at == LimitAt::neutral || !(limit.high < infinity)) continue;
    LegRange range;
    range.limit = limit.label();
    range.size = problem.unit();
    range.spread = *row;
    range.in_zp = limit.of == Unit::zp;
    range.most = limit.high;
    range.set_zp(1.0);
    out.push_back(std::move(range));
  }
  return out;
}

std::vector<LegRange> leg_ranges(const Problem& problem, double zp, const std::vector<Vec9>& lengths) {
  if (lengths.empty()) throw InvalidArgument("lengths", "none", "those at one pose or more");
  Vec9 shortest = lengths.front(), longest = lengths.front();
  for (const Vec9& at_pose : lengths) {
    shortest = shortest.cwiseMin(at_pose);
    longest = longest.cwiseMax(at_pose);
  }
  std::vector<LegRange> out = leg_ranges(problem);
  for (LegRange& range : out) {
    range.set_zp(zp);
    range.surround(shortest, longest);
  }
  return out;
}

LegLimits common_range(const std::vector<LegRange>& ranges, const LegLimits& limits) {
  LegLimits out = limits;
  for (const LegRange& range : ranges) {
    const auto length = [&](double measure) { return range.length(measure); };
    out.low = out.low.cwiseMax(range.low.unaryExpr(length));
    out.high = out.high.cwiseMin(range.high.unaryExpr(length));
  }
  return out;
}

}  // namespace ninedof
