#include "optimize/region/look.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "math/numbers.hpp"
#include "math/sort_by.hpp"
#include "ninedof/optimize/evaluate.hpp"
#include "ninedof/optimize/leg_range.hpp"
#include "ninedof/robot/legs.hpp"
#include "optimize/region/design_at_poses.hpp"

namespace ninedof {
namespace {

/// A worst is one that nearly passes below this margin, or this near to the largest index.
constexpr double worst_window = 2e-3;
constexpr double one_pose = 1e-7;  // of the region: nearer poses are one

/// The row behind the name of a margin; null for a limit on the condition number.
const LimitRow* row_named(const std::string& name) {
  const auto rows = limit_rows();
  const auto found = std::ranges::find_if(rows, [&](const LimitRow& row) { return name == row.info.name; });
  return found == rows.end() ? nullptr : &*found;
}

/// What a limit looks at: the poses of a region, all of them together, or neither.
bool is_of_poses(const std::string& name) {
  const LimitRow* row = row_named(name);
  return row != nullptr ? row->pose != nullptr : !name.ends_with(" at neutral");
}
bool is_of_spread(const std::string& name) {
  const LimitRow* row = row_named(name);
  return row != nullptr && row->spread != nullptr;
}

bool compares_poses(const Problem& problem) {
  return std::ranges::any_of(problem.limits, [](const Limit& l) { return is_of_spread(l.label()); });
}

/// Whether a limit wants legs to differ by no less.
bool wants_spread(const Problem& problem) {
  return std::ranges::any_of(problem.limits, [](const Limit& l) { return is_of_spread(l.label()) && l.low > 0.0; });
}

/// Of the poses where legs are longest or shortest in a region, those of legs that nearly break a limit that compares
/// poses, listed ones too; all where a limit wants legs to differ. `there` ends with these poses: nine longest, nine
/// shortest.
std::vector<Look::Worst> nearly_too_far_apart(const Problem& there, const Eigen::VectorXd& x,
                                              const RegionWorst& found) {
  const Geometry g = geometry(there, x);
  const std::vector<Configuration> all = configurations(there, x);  // the first is the neutral one
  Eigen::Matrix<double, 9, Eigen::Dynamic> lengths(9, static_cast<Eigen::Index>(all.size()) - 1);
  for (std::size_t k = 1; k < all.size(); ++k) lengths.col(static_cast<Eigen::Index>(k) - 1) = leg_lengths(g, all[k]);
  const Vec9 longest = lengths.rowwise().maxCoeff(), shortest = lengths.rowwise().minCoeff();
  const Vec9 long_here = lengths.rightCols<18>().leftCols<9>().diagonal();
  const Vec9 short_here = lengths.rightCols<9>().diagonal();
  std::array<bool, 9> long_joins;
  long_joins.fill(wants_spread(there));
  std::array<bool, 9> short_joins = long_joins;
  for (LegRange& range : leg_ranges(there)) {
    range.set_zp(x[design_family(there.family).index("zp")]);
    const auto measured = [&](double length) { return range.measured(length); };
    const Vec9 high = longest.unaryExpr(measured), low = shortest.unaryExpr(measured);
    const double near = range.width() - worst_window;
    for (Eigen::Index leg = 0; leg < 9; ++leg) {
      const double top = range.spread.each_leg ? high[leg] : high.maxCoeff();
      const double bottom = range.spread.each_leg ? low[leg] : low.minCoeff();
      long_joins[at_index(leg)] |= measured(long_here[leg]) - bottom > near;
      short_joins[at_index(leg)] |= top - measured(short_here[leg]) > near;
    }
  }
  std::vector<Look::Worst> out;
  for (int leg = 0; leg < 9; ++leg) {
    const std::size_t k = at_index(leg);
    if (long_joins[k]) out.push_back({found.longest_at[k], RegionNumber::longest + leg});
    if (short_joins[k]) out.push_back({found.shortest_at[k], RegionNumber::shortest + leg});
  }
  return out;
}

}  // namespace

double imposed_index(const Problem& problem, const Region& region, const Imposed& imposed, const Eigen::VectorXd& x) {
  if (problem.objective.aggregate == Aggregate::mean_inverse) return infinity;
  Problem worst = posed(problem, poses_of(problem, region, imposed));
  worst.objective.aggregate = Aggregate::worst;
  worst.limits.clear();
  return evaluate(worst, x).log_objective;
}

Look look_over(const Problem& problem, const Region& region, const Imposed& imposed, const Eigen::VectorXd& x,
               const RegionSettings& settings, const Control& control) {
  const Problem alone = without_poses(problem);
  const RegionWorst found = search_region(alone, region, own_variables(problem, x), settings, control);
  struct Worse {
    double by;
    Vec6 at;
    int number;
  };
  std::vector<Worse> worse;
  Look out;
  out.poses = found.poses;
  out.margin = infinity;
  out.excess = -infinity;
  const auto take_margin = [&](double margin, const std::string& name) {
    out.excess = std::max(out.excess, -margin);
    double& least = out.passed[name];
    least = std::max(least, -margin);
    if (margin >= out.margin) return;
    out.margin = margin;
    out.limit = name;
  };
  for (const RegionWorst::Limit& limit : found.limits) {
    if (is_of_spread(limit.name)) continue;
    take_margin(limit.margin, limit.name);
    if (limit.margin < worst_window && is_of_poses(limit.name))
      worse.push_back({-limit.margin, limit.at, RegionNumber::first_margin + limit.row});
  }
  const double held = imposed_index(problem, region, imposed, x);
  out.log_index = -infinity;
  for (const RegionWorst::Index& end : found.index)
    if (end.logarithm > out.log_index) {
      out.log_index = end.logarithm;
      out.log_index_at = end.at;
    }
  if (held < infinity) out.gain = std::max(0.0, out.log_index - held);
  out.excess = std::max(out.excess, out.log_index - held);
  for (const RegionWorst::Index& end : found.index)
    if (end.logarithm > held - worst_window) worse.push_back({end.logarithm - held, end.at, RegionNumber::index});
  if (compares_poses(problem)) {
    // Margins of limits that compare poses are those at the poses where legs are longest and shortest.
    Imposed extremes;
    for (const auto* ends : {&found.longest_at, &found.shortest_at})
      std::ranges::copy(*ends, std::back_inserter(extremes.at));
    Problem there = posed(problem, poses_of(problem, region, extremes));
    there.objective.aggregate = Aggregate::worst;
    for (const Look::Worst& w : nearly_too_far_apart(there, x, found)) worse.push_back({0.0, w.at, w.number});
    for (const Evaluation::Margin& margin : evaluate(there, x).margins)
      if (is_of_spread(margin.name)) take_margin(margin.value, margin.name);
  }
  sort_by(worse, [](const Worse& one) { return -one.by; });
  for (const Worse& w : worse)
    if (std::ranges::none_of(out.worst,
                             [&](const Look::Worst& o) { return distance_in(region, o.at, w.at) <= one_pose; }))
      out.worst.push_back({w.at, w.number});
  return out;
}

std::string so_far(double objective, double excess, int rounds, double passed, const RoundClock& clock) {
  const double rate = std::clamp(std::pow(excess, 1.0 / rounds), 0.05, 0.7);
  const double ahead = std::max(1.0, std::ceil(std::log(passed / excess) / std::log(rate)));
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                ": %.7g so far, passed by %.1e between them, about %.0f round%s or %.0f s more", objective, excess,
                ahead, ahead > 1.0 ? "s" : "", std::ceil(ahead * clock.seconds()));
  return text.data();
}

std::vector<Vec6> nearly_deciding(const Problem& problem, const Region& region, const std::vector<Vec6>& at,
                                  const Eigen::VectorXd& x, double near) {
  DesignAtPoses design(problem, region, own_variables(problem, x));
  const auto count = design.margins();
  std::vector<int> of_poses;
  for (int k = 0; k < count; ++k)
    if (is_of_poses(design.margin_name(k))) of_poses.push_back(k);
  const auto n = static_cast<Eigen::Index>(at.size());
  Eigen::VectorXd index(n), margin = Eigen::VectorXd::Constant(n, infinity);
  Eigen::Matrix<double, 9, Eigen::Dynamic> lengths(9, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    design.look_at(at[at_index(k)]);
    index[k] = design.log_index();
    for (const int row : of_poses) margin[k] = std::min(margin[k], design.margin(row));
    lengths.col(k) = design.lengths();
  }
  const bool means = problem.objective.aggregate == Aggregate::mean_inverse;
  const bool spreads = compares_poses(problem);
  const Vec9 longest = lengths.rowwise().maxCoeff(), shortest = lengths.rowwise().minCoeff();
  std::vector<Vec6> out;
  for (Eigen::Index k = 0; k < n; ++k) {
    const bool extreme = spreads && ((lengths.col(k).array() >= longest.array() * (1.0 - near)).any() ||
                                     (lengths.col(k).array() <= shortest.array() * (1.0 + near)).any());
    const bool worst = !means && index[k] >= index.maxCoeff() - near;
    if (extreme || worst || margin[k] <= near) out.push_back(at[at_index(k)]);
  }
  return out;
}

}  // namespace ninedof
