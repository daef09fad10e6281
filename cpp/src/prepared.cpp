#include "prepared.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof {
namespace {

/// A margin that is not a number, or infinitely bad, counts as this: logarithms of ratios of doubles end there.
constexpr double hopeless = -700.0;

const std::string condition_limit_name = "condition_limit";

bool limits_condition(const Problem& p) {
  return std::isfinite(p.objective.condition_limit);
}

int pair_rows(bool closed) {
  return index_rows(Index::condition_number, closed);
}

/// Margins of the limit on the condition number: log(limit) less the difference of two singular values' logarithms.
void fill_condition_margin(const Problem& problem, const PoseSpectrum& s, int row, double& value, Row gradient) {
  const std::vector<int> tops = s.tops(), bottoms = s.bottoms();
  const auto count = static_cast<int>(bottoms.size());
  const int top = tops[static_cast<std::size_t>(row / count)], bottom = bottoms[static_cast<std::size_t>(row % count)];
  value = std::log(problem.objective.condition_limit) - (s.log_sigma[top] - s.log_sigma[bottom]);
  gradient = s.gradient.row(bottom) - s.gradient.row(top);
}

}  // namespace

namespace {

int count_helpers(const Problem& problem) {
  int count = 0;
  for (const Limit& limit : problem.limits)
    count += make_constraint(limit, static_cast<int>(problem.objective.poses.size()), Purpose::solve)->helpers();
  return count;
}

}  // namespace

Prepared::Prepared(const Problem& given, double cap)
    : problem(given), family(&design_family(given.family)), coordinates(given, cap, count_helpers(given)) {
  place_poses();
  count_rows(Purpose::solve);
  drop_repeated_margins();
}

Prepared::Prepared(const Problem& given)
    : problem(given), family(&design_family(given.family)), coordinates(Coordinates::plain(given)) {
  place_poses();
  count_rows(Purpose::look);
}

void Prepared::place_poses() {
  const auto& poses = problem.objective.poses;
  looked = static_cast<int>(poses.size());
  places.push_back({});
  for (std::size_t k = 0; k < poses.size(); ++k) {
    Place place{poses[k], 1.0, offset_variables(problem, k)};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (place.offset[axis] >= 0) place.coordinate[axis] = coordinates.coordinate(place.offset[axis]);
    places.push_back(place);
  }
  int steps = 1;
  for (const Limit& l : problem.limits)
    if (l.name == "singularity_free") steps = l.steps;
  for (std::size_t k = 1; k <= poses.size(); ++k)
    for (int step = 1; step < steps; ++step) {
      Place between = places[k];
      between.fraction = static_cast<double>(step) / steps;
      places.push_back(between);
    }
}

void Prepared::count_rows(Purpose purpose) {
  const Objective& o = problem.objective;
  const int poses = std::max(looked, 1);
  for (int k = 0; k < poses; ++k) {
    const Place& place = places[static_cast<std::size_t>(looked > 0 ? k + 1 : 0)];
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
    const int own = constraints.back()->helpers();
    if (own > 0) constraints.back()->set_helpers(visible + helpers, coordinates.coordinate(visible + helpers));
    helpers += own;
  }
  for (std::size_t k = 0; k < constraints.size(); ++k)
    for (int row = 0; row < constraints[k]->rows(); ++row) margins.push_back({static_cast<int>(k), row});
  if (limits_condition(problem))
    for (int k = 0; k < poses; ++k)
      for (int pair = 0; pair < pair_rows(closed[static_cast<std::size_t>(k)]); ++pair)
        margins.push_back({-1 - k, pair});
}

void Prepared::drop_repeated_margins() {
  // Symmetry makes many margins the same function: those that agree at a few unrelated designs.
  constexpr int probes = 3;
  std::vector<Eigen::VectorXd> seen;
  Look l;
  for (int k = 0; k < probes; ++k) {
    // Places of s and helping variables are their own: no two margins may agree for their sake.
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
      return std::abs(x - y) <= 1e-11 * std::max(1.0, std::abs(x)) && x > hopeless;
    });
  };
  std::vector<MarginRow> kept;
  std::vector<std::size_t> kept_at;
  for (std::size_t k = 0; k < margins.size(); ++k) {
    const bool repeated = std::ranges::any_of(
        kept_at, [&](std::size_t j) { return margins[j].constraint == margins[k].constraint && same(j, k); });
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

Eigen::VectorXd Prepared::helped(const Eigen::VectorXd& y) const {
  if (helpers == 0) return y;
  View v;
  v.set(*family, coordinates, problem.characteristic_length, places, looked, y);
  v.unit = problem.unit();
  Eigen::VectorXd x = v.x;
  for (const auto& c : constraints)
    for (int k = 0; k < c->helpers(); ++k) x[c->first_helper() + k] = c->helper(v, k);
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

namespace {

void look_at_margins(const Prepared& p, const Wanted* wanted, Look& out) {
  const auto count = static_cast<Eigen::Index>(p.margins.size());
  out.m.resize(count);
  out.m_gradient.resize(count, p.coordinates.size());
  Eigen::RowVectorXd unused(p.coordinates.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto [constraint, row] = p.margins[static_cast<std::size_t>(k)];
    if (constraint < 0)
      fill_condition_margin(p.problem, out.spectra[static_cast<std::size_t>(-1 - constraint)], row, out.m[k], unused);
    else out.m[k] = p.constraints[static_cast<std::size_t>(constraint)]->margin(out.view, row);
    if (!(out.m[k] > hopeless)) out.m[k] = hopeless;
  }
  const auto differentiate = [&](Eigen::Index k) {
    const auto [constraint, row] = p.margins[static_cast<std::size_t>(k)];
    out.m_gradient.row(k).setZero();
    if (out.m[k] <= hopeless) return;
    double value = 0.0;
    if (constraint < 0)
      fill_condition_margin(p.problem, out.spectra[static_cast<std::size_t>(-1 - constraint)], row, value,
                            out.m_gradient.row(k));
    else p.constraints[static_cast<std::size_t>(constraint)]->add_gradient(out.view, row, out.m_gradient.row(k));
  };
  if (wanted == nullptr)
    for (Eigen::Index k = 0; k < count; ++k) differentiate(k);
  else
    for (const int k : wanted->margins) differentiate(k);
}

}  // namespace

void look(const Prepared& p, const Eigen::VectorXd& y, Look& out, const Wanted* wanted) {
  out.view.set(*p.family, p.coordinates, p.problem.characteristic_length, p.places, p.looked, y);
  out.view.unit = p.problem.unit();
  const Eigen::Index n = p.coordinates.size();
  const int poses = std::max(p.looked, 1);
  const Machine machine = p.problem.objective.index == Index::six_legged ? Machine::six_legged : Machine::nine_legged;
  out.spectra.resize(static_cast<std::size_t>(poses));
  out.f.resize(p.rows);
  out.f_gradient.resize(p.rows, n);
  for (int k = 0; k < poses; ++k) {
    PoseSpectrum& s = out.spectra[static_cast<std::size_t>(k)];
    const int place = out.view.first + k;
    if (p.closed[static_cast<std::size_t>(k)])
      closed_spectrum(*p.family, out.view, p.places[static_cast<std::size_t>(place)], machine, s);
    else general_spectrum(out.view, place, s, wanted == nullptr || wanted->poses[static_cast<std::size_t>(k)]);
    if (out.smoothing > 0.0 && p.kinked() && !s.closed)
      fill_soft_index(p.problem.objective.index, s, out.smoothing, p.first_row(k), out.f, out.f_gradient);
    else fill_index(p.problem.objective.index, s, p.first_row(k), out.f, out.f_gradient);
  }
  out.levels.setConstant(p.levels, -std::numeric_limits<double>::infinity());
  for (const Use& u : p.uses) out.levels[u.level] = std::max(out.levels[u.level], out.f[u.row]);
  out.log_objective = p.objective(out.levels);

  look_at_margins(p, wanted, out);
}

double order_violation(const Prepared& p, const Look& l, const Eigen::VectorXd& y) {
  // zs < zp is strict: what is beyond it by any rounding is no design, whatever the tolerance for other limits.
  if (p.coordinates.order_margin(y) >= 0.0) return 0.0;
  return std::max(1e-6, std::log(l.view.blueprint.zs / std::max(l.view.blueprint.zp, 1e-300)));
}

double violation(const Prepared& p, const Look& l, const Eigen::VectorXd& y) {
  double worst = order_violation(p, l, y);
  if (l.m.size() > 0) worst = std::max(worst, -l.m.minCoeff());
  return worst;
}

double neutral_condition(const Prepared& p, const Look& l) {
  PoseSpectrum s;
  if (p.family->symmetric()) closed_spectrum(*p.family, l.view, p.places.front(), Machine::nine_legged, s);
  else general_spectrum(l.view, 0, s);
  return std::exp(s.log_max() - s.log_min());
}

std::vector<double> conditions(const Prepared& p, const Look& l) {
  if (p.problem.objective.index == Index::six_legged) return {neutral_condition(p, l)};
  std::vector<double> out;
  for (const PoseSpectrum& s : l.spectra) out.push_back(std::exp(s.log_max() - s.log_min()));
  return out;
}

}  // namespace ninedof
