/// Declared in optimize/polish/active_set.hpp.

#include <array>
#include <cmath>

#include "math/linear/least_squares.hpp"
#include "math/numbers.hpp"
#include "optimize/polish/active_set.hpp"
#include "optimize/polish/cluster.hpp"

namespace ninedof {
namespace {

constexpr double cluster_tie = 1e-6;  // of logarithms of singular values that count as one
constexpr double least_weight = 1e-6;  // of what holds a design; those of a level sum to its slope
constexpr std::array narrower_ties{1e-10, 1e-9, 1e-8, 1e-7};
constexpr double stationary_residual = 1e-6;  // see Candidate::stationary
constexpr int cluster_rounds = 40;    // directions added one by one; two or three settle a pair

/// Columns of the least-squares problem: a derivative in solver coordinates, the level its weight counts for, and the
/// item of ActiveSet::row_levels it belongs to, or -1 each.
struct Columns {
  std::vector<Eigen::VectorXd> gradient;
  std::vector<int> level, row;

  void add(Eigen::VectorXd g, int of_level = -1, int of_row = -1) {
    gradient.push_back(std::move(g));
    level.push_back(of_level);
    row.push_back(of_row);
  }
  Eigen::Index count() const { return static_cast<Eigen::Index>(gradient.size()); }
};

struct Weights {
  Eigen::VectorXd w, residual;
};

/// Least residual over nonnegative weights. That the weights of a level sum to its slope is a row of the problem,
/// scaled like the largest gradient, and is made exact afterwards.
Weights balance(const Columns& c, const Eigen::VectorXd& slopes, Eigen::Index n) {
  const Eigen::Index levels = slopes.size();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + levels, c.count());
  for (Eigen::Index k = 0; k < c.count(); ++k) system.col(k).head(n) = c.gradient[at_index(k)];
  const double heavy = std::max(1.0, system.cwiseAbs().maxCoeff());
  for (Eigen::Index k = 0; k < c.count(); ++k) {
    const int level = c.level[at_index(k)];
    if (level >= 0) system(n + level, k) = heavy;
  }
  Eigen::VectorXd target = Eigen::VectorXd::Zero(n + levels);
  target.tail(levels) = heavy * slopes;
  Weights out{nonnegative_least_squares(system, target), {}};
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(levels);
  for (Eigen::Index k = 0; k < c.count(); ++k)
    if (c.level[at_index(k)] >= 0) sums[c.level[at_index(k)]] += out.w[k];
  for (Eigen::Index k = 0; k < c.count(); ++k) {
    const int level = c.level[at_index(k)];
    if (level >= 0 && sums[level] > 0.0) out.w[k] *= slopes[level] / sums[level];
  }
  out.residual = system.topRows(n) * out.w;
  return out;
}

/// Adds directions of clusters until none reduces the residual.
Weights balance_clusters(const PreparedProblem& p, const DesignEvaluation& design, const ActiveSet& a,
                         const Eigen::VectorXd& slopes, Columns& columns) {
  const Eigen::Index n = p.coordinates.size();
  Weights now = balance(columns, slopes, n);
  struct OfRow {
    Cluster cluster;
    int level, row;
  };
  std::vector<OfRow> clusters;
  const int poses = p.evaluated_poses();
  for (int pose = 0; pose < poses; ++pose) {
    std::vector<std::pair<int, int>> levels;  // with the first active row
    for (std::size_t k = 0; k < a.row_levels.size(); ++k) {
      const RowLevel& u = p.row_levels[at_index(a.row_levels[k])];
      const bool of_pose = u.row >= p.first_row(pose) && u.row < p.first_row(pose + 1);
      const bool known = std::ranges::any_of(levels, [&](const auto& l) { return l.first == u.level; });
      if (of_pose && !known) levels.emplace_back(u.level, static_cast<int>(k));
    }
    if (levels.empty()) continue;
    const Cluster cluster(p, design, pose, cluster_tie);
    if (!cluster.ambiguous()) continue;
    for (const auto& [level, row] : levels) clusters.push_back({cluster, level, row});
  }
  for (int round = 0; round < cluster_rounds && !clusters.empty() && now.residual.norm() > 1e-10; ++round) {
    bool added = false;
    for (const auto& [cluster, level, row] : clusters) {
      Eigen::VectorXd g = cluster.steepest(now.residual);
      double best = infinity;
      for (Eigen::Index k = 0; k < columns.count(); ++k)
        if (columns.level[at_index(k)] == level) best = std::min(best, columns.gradient[at_index(k)].dot(now.residual));
      if (g.dot(now.residual) >= best - 1e-9 * now.residual.norm()) continue;
      columns.add(std::move(g), level, row);
      added = true;
    }
    if (!added) break;
    now = balance(columns, slopes, n);
  }
  return now;
}

/// The active set without the rows and margins of no weight; columns of margins begin at `first_margin`.
ActiveSet carrying(const ActiveSet& a, const Columns& columns, const Eigen::VectorXd& w, std::size_t first_margin) {
  std::vector<bool> carries(a.row_levels.size(), false);
  for (Eigen::Index k = 0; k < columns.count(); ++k)
    if (columns.row[at_index(k)] >= 0 && w[k] > least_weight) carries[at_index(columns.row[at_index(k)])] = true;
  ActiveSet out{{}, {}, a.at_low, a.at_high, a.order};
  for (std::size_t k = 0; k < carries.size(); ++k)
    if (carries[k]) out.row_levels.push_back(a.row_levels[k]);
  for (std::size_t k = 0; k < a.margins.size(); ++k)
    if (w[static_cast<Eigen::Index>(first_margin + k)] > least_weight) out.margins.push_back(a.margins[k]);
  return out;
}

/// The weighted distances of rows from their level and of margins from zero.
double slack_of(const PreparedProblem& p, const DesignEvaluation& design, const ActiveSet& a, const Columns& columns,
                const Eigen::VectorXd& w, std::size_t first_margin) {
  double out = 0.0;
  for (Eigen::Index k = 0; k < columns.count(); ++k)
    if (const int item = columns.row[at_index(k)]; item >= 0) {
      const RowLevel& u = p.row_levels[at_index(a.row_levels[at_index(item)])];
      out += w[k] * (design.levels[u.level] - design.objective_rows[u.row]);
    }
  for (std::size_t k = 0; k < a.margins.size(); ++k)
    out += w[static_cast<Eigen::Index>(first_margin + k)] * std::max(0.0, design.margins[a.margins[k]]);
  return out;
}

/// Whether the index has its least possible value, 1 or, in the Frobenius norm, 6; it has no derivatives there.
bool least_possible(const PreparedProblem& p, const DesignEvaluation& design) {
  const Index index = p.problem.objective.index;
  const double least = index == Index::frobenius ? std::log(6.0) : 0.0;
  return index != Index::speed && design.levels.maxCoeff() <= least + 1e-9;
}

/// Per cent of the objective for one per cent of a bound, per unit of weight.
double bound_price(const PreparedProblem& p, const DesignEvaluation& design, int coordinate) {
  const double x = design.state.x[p.coordinates.variable(coordinate)];
  return std::abs(x) / p.coordinates.slopes(design.state.x)[coordinate];
}

}  // namespace

Stationarity stationarity(const PreparedProblem& p, const DesignEvaluation& design, const ActiveSet& a) {
  const Eigen::Index n = p.coordinates.size();
  if (n == 0) return {};
  if (!design.objective_rows.allFinite() || !design.row_gradient.allFinite() || !design.margin_gradient.allFinite())
    return {infinity, 0.0, {}, {}};
  if (least_possible(p, design)) return {};
  Columns columns;
  for (std::size_t k = 0; k < a.row_levels.size(); ++k) {
    const RowLevel& u = p.row_levels[at_index(a.row_levels[k])];
    columns.add(design.row_gradient.row(u.row), u.level, static_cast<int>(k));
  }
  // Margins are relative to their limit: the price is the weight times 1, or 0 for rows of auxiliary variables.
  std::vector<std::pair<std::string, double>> named;  // and the factor from weight to price
  const auto limited = at_index(columns.count());
  for (const int k : a.margins) {
    columns.add(-design.margin_gradient.row(k));
    named.emplace_back(p.margin_name(k), p.margin_price(k));
  }
  const auto add_bound = [&](int k, const Eigen::VectorXd& outwards, bool internal) {
    columns.add(outwards);
    named.emplace_back(internal ? "" : p.coordinates.info(k).name, bound_price(p, design, k));
  };
  for (const int k : a.at_low) add_bound(k, -Eigen::VectorXd::Unit(n, k), p.coordinates.internal_low(k));
  for (const int k : a.at_high) add_bound(k, Eigen::VectorXd::Unit(n, k), p.coordinates.internal_high(k));
  if (a.order) {
    columns.add(-p.coordinates.order().gradient);
    named.emplace_back("", 0.0);
  }
  Eigen::VectorXd slopes;
  p.objective(design.levels, &slopes);
  const Weights settled = balance_clusters(p, design, a, slopes, columns);
  Stationarity out;
  out.residual = settled.residual.norm();
  out.slack = slack_of(p, design, a, columns, settled.w, limited);
  for (std::size_t k = 0; k < named.size(); ++k) {
    const auto& [name, factor] = named[k];
    if (!name.empty()) out.prices[name] += factor * settled.w[static_cast<Eigen::Index>(limited + k)];
  }
  std::erase_if(out.prices, [](const auto& price) { return !(price.second > 1e-9); });
  out.support = carrying(a, columns, settled.w, limited);
  return out;
}

double least_slack(const PreparedProblem& p, const Eigen::VectorXd& at) {
  const Eigen::VectorXd y = p.with_auxiliary(at);
  double out = 0.0;
  for (const int piece : p.pieces(y)) {
    DesignEvaluation design;
    design.state.length_joint = piece;
    const ActiveSet all = evaluate_active(p, y, Contact::exact, design);
    Stationarity found = stationarity(p, design, all);
    for (const double tie : narrower_ties) {
      ActiveSet a = all;
      std::erase_if(a.row_levels, [&](int k) {
        const RowLevel& u = p.row_levels[at_index(k)];
        return design.levels[u.level] - design.objective_rows[u.row] > tie;
      });
      std::erase_if(a.margins, [&](int k) { return design.margins[k] > tie; });
      const Stationarity narrower = stationarity(p, design, a);
      if (!(narrower.residual <= stationary_residual)) continue;
      found = narrower;
      break;
    }
    out = std::max(out, found.slack);
  }
  return out;
}

}  // namespace ninedof
