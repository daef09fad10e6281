#include "problem/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/numbers.hpp"
#include "math/splitmix.hpp"

namespace ninedof {
namespace {

/// Least zp - zs in solver coordinates: at zero the upper internal legs would lie in the platform plane.
constexpr double order_gap = 1e-10;

constexpr double full_turn = 2.0 * std::numbers::pi;

/// Half range of the starts of an angle without bounds.
constexpr double beyond_turn = 0.625 * full_turn;

/// Bounds this much less than a turn apart are a turn apart, but for rounding.
constexpr double rounding = 1e-9;

/// Distance from a bound that counts as rounding error.
constexpr double snap = 1e-13;

/// The unit of the coordinates: bounds of small robots must not all fall into the linear part.
double unit_of(const Problem& problem, const std::vector<Variable>& all) {
  double unit = problem.unit();
  for (const Variable& v : all) {
    const bool sized = v.kind == VariableKind::length || v.kind == VariableKind::coordinate;
    if (sized && !v.internal_bounds && v.bounds.low < v.bounds.high)
      unit = std::min(unit, 0.2 * std::max(v.bounds.high, -v.bounds.low));
  }
  return unit;
}

/// A generalised golden ratio: the root of x^(n+1) = x + 1, whose powers make an evenly spread additive sequence.
double golden(int n) {
  double x = 1.5;
  for (int k = 0; k < 60; ++k) x = std::pow(1.0 + x, 1.0 / (n + 1));
  return x;
}

}  // namespace

bool is_effective_bound(const Problem& problem, double bound) {
  return std::abs(bound) < 1e6 * problem.unit();
}

Coordinates::Coordinates(const Problem& problem, double size_limit, int auxiliary_count)
    : all_(full_variables(problem)) {
  for (int k = 0; k < auxiliary_count; ++k) all_.push_back({"", VariableKind::fraction, {-infinity, infinity}, true});
  unit_ = unit_of(problem, all_);
  const auto n = static_cast<Eigen::Index>(all_.size());
  fixed_.resize(n);
  x_low_.resize(n);
  x_high_.resize(n);
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Bounds& b = all_[i].bounds;
    const bool angle = all_[i].kind == VariableKind::angle, free = b.low < b.high;
    const bool signed_length = all_[i].kind == VariableKind::coordinate;
    const bool cut_low = free && (angle ? !std::isfinite(b.low)
                                        : signed_length && !is_effective_bound(problem, b.low) && -size_limit > b.low);
    const bool fraction = all_[i].kind == VariableKind::fraction;
    const bool cut_high =
        free && !fraction &&
        (angle ? !std::isfinite(b.high) : !is_effective_bound(problem, b.high) && size_limit < b.high);
    x_low_[k] = !cut_low ? b.low : !angle ? -size_limit : cut_high ? -beyond_turn : b.high - 2.0 * beyond_turn;
    x_high_[k] = !cut_high ? b.high : angle ? x_low_[k] + 2.0 * beyond_turn : size_limit;
    fixed_[k] = x_low_[k];
    if (!free) continue;
    free_.push_back(static_cast<int>(i));
    round_.push_back(angle && x_high_[k] - x_low_[k] >= full_turn - rounding);
    internal_low_.push_back(!round_.back() && (cut_low || all_[i].internal_bounds));
    internal_high_.push_back(!round_.back() && (cut_high || all_[i].internal_bounds));
  }
  low_.resize(size());
  high_.resize(size());
  for (int k = 0; k < size(); ++k) {
    low_[k] = round_[at_index(k)] ? -infinity : to_y(variable(k), x_low_[variable(k)]);
    high_[k] = round_[at_index(k)] ? infinity : to_y(variable(k), x_high_[variable(k)]);
  }
  zp_variable_ = design_family(problem.family).index("zp");
  length_variable_ = ninedof::length_variable(problem);
  const int zs_variable = design_family(problem.family).index("zs");
  zp_ = coordinate(zp_variable_);
  zs_ = coordinate(zs_variable);
  y_zp_ = to_y(zp_variable_, fixed_[zp_variable_]);
  y_zs_ = to_y(zs_variable, fixed_[zs_variable]);
  order_ = {Eigen::VectorXd::Zero(size()), -order_gap};
  if (zp_ >= 0) order_.gradient[zp_] = 1.0;
  else order_.constant += y_zp_;
  if (zs_ >= 0) order_.gradient[zs_] = -1.0;
  else order_.constant -= y_zs_;
}

int Coordinates::coordinate(int variable) const {
  const auto at = std::find(free_.begin(), free_.end(), variable);
  return at == free_.end() ? -1 : static_cast<int>(at - free_.begin());
}

Coordinates Coordinates::plain(const Problem& problem) {
  Coordinates c;
  c.plain_ = true;
  c.all_ = full_variables(problem);
  c.unit_ = problem.unit();
  c.length_variable_ = ninedof::length_variable(problem);
  const auto n = static_cast<Eigen::Index>(c.all_.size());
  for (int k = 0; k < n; ++k) c.free_.push_back(k);
  c.fixed_.setZero(n);
  c.low_.setConstant(n, -infinity);
  c.high_.setConstant(n, infinity);
  c.round_.assign(at_index(n), false);
  c.x_low_ = c.low_;
  c.x_high_ = c.high_;
  return c;
}

Coordinates Coordinates::fixed(const Problem& problem, const Eigen::VectorXd& variables) {
  Coordinates c = plain(problem);
  c.fixed_ = variables;
  c.free_.clear();
  c.round_.clear();
  c.low_.resize(0);
  c.high_.resize(0);
  return c;
}

bool Coordinates::scaled(int variable) const {
  const VariableKind kind = all_[at_index(variable)].kind;
  return !plain_ && (kind == VariableKind::length || kind == VariableKind::coordinate);
}

double Coordinates::to_y(int variable, double x) const {
  return scaled(variable) ? std::asinh(x / unit_) : x;
}

double Coordinates::to_x(int variable, double y) const {
  return scaled(variable) ? unit_ * std::sinh(y) : y;
}

double Coordinates::within_turn(int k, double y) const {
  double low = x_low_[variable(k)], high = x_high_[variable(k)];
  if (low == -beyond_turn && high == beyond_turn) {
    // Without bounds every value is as good: the one a reader expects.
    low = -0.5 * full_turn;
    high = 0.5 * full_turn;
  }
  if (y >= low && y <= high) return y;
  return std::clamp(y - full_turn * std::floor((y - low) / full_turn), low, high);
}

Eigen::VectorXd Coordinates::variables(const Eigen::VectorXd& y) const {
  Eigen::VectorXd x = fixed_;
  for (int k = 0; k < size(); ++k) {
    const int v = variable(k);
    if (round_[at_index(k)]) {
      x[v] = within_turn(k, y[k]);
      continue;
    }
    // Exact bounds, not the round trip through asinh; a solver's rounding does not leave a side of 1e-16.
    if (y[k] <= low_[k] + snap) x[v] = x_low_[v];
    else if (y[k] >= high_[k] - snap) x[v] = x_high_[v];
    else x[v] = std::clamp(to_x(v, y[k]), x_low_[v], x_high_[v]);
  }
  return x;
}

Eigen::VectorXd Coordinates::coordinates(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y(size());
  for (int k = 0; k < size(); ++k) {
    const double value = variable(k) < x.size() ? x[variable(k)] : 0.0;
    y[k] = std::clamp(to_y(variable(k), value), low_[k], high_[k]);
  }
  return y;
}

Eigen::VectorXd Coordinates::slopes(const Eigen::VectorXd& x) const {
  Eigen::VectorXd out(size());
  for (int k = 0; k < size(); ++k) out[k] = scaled(variable(k)) ? std::hypot(unit_, x[variable(k)]) : 1.0;
  return out;
}

Eigen::VectorXd Coordinates::start(int index, std::uint64_t seed) const {
  const double ratio = golden(size());
  Eigen::VectorXd u(size());
  double step = 1.0;
  for (int k = 0; k < size(); ++k) {
    step /= ratio;
    const double t = uniform_from(stream(seed, static_cast<std::uint64_t>(k))) + (index + 1.0) * step;
    u[k] = t - std::floor(t);
  }
  Eigen::VectorXd y(size());
  for (int k = 0; k < size(); ++k) {
    const int v = variable(k);
    const double low = round_[at_index(k)] ? x_low_[v] : low_[k], high = round_[at_index(k)] ? x_high_[v] : high_[k];
    y[k] = low + u[k] * (high - low);
  }
  // Draw zp above the smallest zs, then zs below zp.
  const double zs_floor = zs_ >= 0 ? low_[zs_] : y_zs_;
  if (zp_ >= 0) {
    const double low = std::clamp(zs_floor + order_gap, low_[zp_], high_[zp_]);
    y[zp_] = low + u[zp_] * (high_[zp_] - low);
  }
  if (zs_ >= 0) {
    const double zp = zp_ >= 0 ? y[zp_] : y_zp_;
    const double high = std::clamp(zp - order_gap, low_[zs_], high_[zs_]);
    y[zs_] = low_[zs_] + u[zs_] * (high - low_[zs_]);
  }
  // Variables with internal bounds start from standard values: s at its stated position, the length at half the height.
  const double zp = to_x(zp_variable_, zp_ >= 0 ? y[zp_] : y_zp_);
  for (int k = 0; k < size(); ++k) {
    if (!info(k).internal_bounds) continue;
    const double value = info(k).kind == VariableKind::fraction ? 0.0 : 0.5 * zp;
    y[k] = std::clamp(to_y(variable(k), value), low_[k], high_[k]);
  }
  return y;
}

}  // namespace ninedof
