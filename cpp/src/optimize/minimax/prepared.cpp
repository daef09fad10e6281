#include "optimize/minimax/prepared.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/minimax/look.hpp"

namespace ninedof {
namespace {

/// Unrelated designs from which it is learned what is so in all of them.
constexpr int probes = 3;

/// Size up to which such designs are drawn where a variable has no serious bound and the solver is not asked.
constexpr double caps_end = 100.0;

const std::string condition_limit_name = "condition_limit";

int pair_rows(bool closed) {
  return index_rows(Index::condition_number, closed);
}

int count_auxiliary(const Problem& problem) {
  int count = 0;
  for (const Limit& limit : problem.limits)
    count +=
        make_constraint(limit, static_cast<int>(problem.objective.poses.size()), Purpose::solve)->auxiliary_count();
  return count;
}

}  // namespace

Prepared::Prepared(const Problem& given, double cap)
    : problem(given), family(&design_family(given.family)), coordinates(given, cap, count_auxiliary(given)) {
  place_poses();
  count_rows(Purpose::solve);
  teach_constraints(coordinates);
  drop_repeated_margins();
}

Prepared::Prepared(const Problem& given)
    : problem(given), family(&design_family(given.family)), coordinates(Coordinates::plain(given)) {
  place_poses();
  count_rows(Purpose::evaluate);
  teach_constraints(Coordinates(given, caps_end * given.unit()));
}

void Prepared::place_poses() {
  const auto& poses = problem.objective.poses;
  looked = static_cast<int>(poses.size());
  places.push_back({});
  for (std::size_t k = 0; k < poses.size(); ++k) {
    PoseSpec place{poses[k], 1.0, offset_variables(problem, k)};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (place.offset[axis] >= 0) place.coordinate[axis] = coordinates.coordinate(place.offset[axis]);
    places.push_back(place);
  }
  int steps = 1;
  for (const Limit& l : problem.limits)
    if (l.name == "singularity_free") steps = l.steps;
  for (std::size_t k = 1; k <= poses.size(); ++k)
    for (int step = 1; step < steps; ++step) {
      PoseSpec between = places[k];
      between.fraction = static_cast<double>(step) / steps;
      places.push_back(between);
    }
}

void Prepared::count_rows(Purpose purpose) {
  const Objective& o = problem.objective;
  const int poses = std::max(looked, 1);
  for (int k = 0; k < poses; ++k) {
    const PoseSpec& place = places[static_cast<std::size_t>(looked > 0 ? k + 1 : 0)];
    closed.push_back(on_axis(problem, place.pose));
    first_row_.push_back(rows);
    rows += index_rows(o.index, closed.back());
  }
  first_row_.push_back(rows);
  const bool single = o.aggregate == Aggregate::worst || poses == 1;
  levels = single ? 1 : o.aggregate == Aggregate::mean_inverse ? poses : poses + 1;
  for (int k = 0; k < poses; ++k)
    for (int row = first_row(k); row < first_row(k + 1); ++row) {
      uses.push_back({row, single ? 0 : k});
      if (!single && o.aggregate == Aggregate::weighted) uses.push_back({row, poses});
    }
  const auto visible = static_cast<int>(full_variables(problem).size());
  for (const Limit& limit : problem.limits) {
    constraints.push_back(make_constraint(limit, looked, purpose));
    const int own = constraints.back()->auxiliary_count();
    if (own > 0)
      constraints.back()->set_auxiliary(visible + auxiliary_count, coordinates.coordinate(visible + auxiliary_count));
    auxiliary_count += own;
  }
  std::vector<int> placed_poses;
  for (int k = 0; k < looked; ++k)
    if (placed(problem.objective.poses[static_cast<std::size_t>(k)])) placed_poses.push_back(k);
  if (purpose == Purpose::solve && !placed_poses.empty())
    constraints.push_back(make_between_plates(std::move(placed_poses)));
  for (std::size_t k = 0; k < constraints.size(); ++k)
    for (int row = 0; row < constraints[k]->rows(); ++row) margins.push_back({static_cast<int>(k), row});
  if (std::isfinite(o.condition_limit))
    for (int k = 0; k < poses; ++k)
      for (int pair = 0; pair < pair_rows(closed[static_cast<std::size_t>(k)]); ++pair)
        margins.push_back({-1 - k, pair});
}

void Prepared::teach_constraints(const Coordinates& within) {
  if (constraints.empty()) return;
  std::vector<DesignState> designs(probes);
  for (int k = 0; k < probes; ++k)
    designs[static_cast<std::size_t>(k)].set(*family, within, problem.characteristic_length, {{}}, 0,
                                             within.start(7 * k + 1, 12345));
  for (const auto& c : constraints) c->learn(designs);
}

void Prepared::drop_repeated_margins() {
  // Symmetry makes many margins the same function: those that agree at a few unrelated designs.
  std::vector<Eigen::VectorXd> seen;
  Look l;
  for (int k = 0; k < probes; ++k) {
    // Places of s and auxiliary variables are their own: no two margins may agree for their sake.
    Eigen::VectorXd y = coordinates.start(7 * k + 1, 12345);
    for (int v = 0; v < coordinates.size(); ++v)
      if (coordinates.info(v).ours && coordinates.info(v).kind == VariableKind::fraction)
        y[v] = 0.01 * std::sin(1.0 + 3.0 * v + 7.0 * k);
    look(*this, y, l);
    seen.push_back(l.m);
  }
  const auto same = [&](std::size_t a, std::size_t b) {
    return std::ranges::all_of(seen, [&](const Eigen::VectorXd& m) {
      const double x = m[static_cast<Eigen::Index>(a)], y = m[static_cast<Eigen::Index>(b)];
      return std::abs(x - y) <= 1e-11 * std::max(1.0, std::abs(x)) && x > hopeless_margin;
    });
  };
  std::vector<MarginRow> kept;
  std::vector<std::size_t> kept_at;
  for (std::size_t k = 0; k < margins.size(); ++k) {
    const int constraint = margins[k].constraint;
    const bool analytic = constraint < 0 || constraints[static_cast<std::size_t>(constraint)]->analytic();
    const bool repeated = analytic && std::ranges::any_of(kept_at, [&](std::size_t j) {
                            return margins[j].constraint == margins[k].constraint && same(j, k);
                          });
    if (repeated) continue;
    kept.push_back(margins[k]);
    kept_at.push_back(k);
  }
  margins = std::move(kept);
}

const std::string& Prepared::margin_name(int k) const {
  const int constraint = margins[static_cast<std::size_t>(k)].constraint;
  return constraint < 0 ? condition_limit_name : constraints[static_cast<std::size_t>(constraint)]->limit().name;
}

bool Prepared::kinked() const {
  const Index index = problem.objective.index;
  return (index == Index::condition_number || index == Index::speed) &&
         std::ranges::find(closed, false) != closed.end();
}

int Prepared::pose_of(int row) const {
  const auto next = std::ranges::upper_bound(first_row_, row);
  return static_cast<int>(next - first_row_.begin()) - 1;
}

double Prepared::margin_price(int k) const {
  const auto [constraint, row] = margins[static_cast<std::size_t>(k)];
  return constraint < 0 ? 1.0 : constraints[static_cast<std::size_t>(constraint)]->price_factor(row);
}

double Prepared::violation_factor(int k) const {
  const auto [constraint, row] = margins[static_cast<std::size_t>(k)];
  return constraint < 0 ? 1.0 : constraints[static_cast<std::size_t>(constraint)]->violation_factor(row);
}

Eigen::VectorXd Prepared::with_auxiliary(const Eigen::VectorXd& y) const {
  if (auxiliary_count == 0) return y;
  DesignState v;
  v.set(*family, coordinates, problem.characteristic_length, places, looked, y);
  v.unit = problem.unit();
  Eigen::VectorXd x = v.x;
  for (const auto& c : constraints)
    for (int k = 0; k < c->auxiliary_count(); ++k) x[c->auxiliary_variable() + k] = c->auxiliary_value(v, k);
  return coordinates.coordinates(x);
}

double Prepared::objective(const Eigen::VectorXd& t, Eigen::VectorXd* slopes) const {
  if (levels == 1) {
    if (slopes != nullptr) slopes->setOnes(1);
    return t[0];
  }
  const Objective& o = problem.objective;
  const Eigen::Index poses = std::max(looked, 1);
  const double least = t.head(poses).minCoeff();
  const Eigen::VectorXd share = (least - t.head(poses).array()).exp();
  const double sum = share.sum();
  const double mean = least - std::log(sum / static_cast<double>(poses));  // -log of the mean of exp(-t)
  const double w = o.aggregate == Aggregate::weighted ? o.weight : 0.0;
  if (slopes != nullptr) {
    slopes->resize(levels);
    slopes->head(poses) = (1.0 - w) / sum * share;
    if (levels > poses) (*slopes)[poses] = w;
  }
  return (1.0 - w) * mean + (levels > poses ? w * t[poses] : 0.0);
}

}  // namespace ninedof
