#include "coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ninedof {
namespace {

/// Least difference of zp and zs in solver coordinates: below it the upper internal legs lie in the platform plane.
constexpr double order_gap = 1e-10;

/// An angle without bounds goes once round, and a little more so that no optimum sits on a bound of ours.
constexpr double turn = 1.25 * std::numbers::pi;

/// Distance from a bound that is rounding.
constexpr double snap = 1e-13;

/// The unit of the coordinates: bounds of small robots must not all fall into the linear part.
double unit_of(const Problem& problem, const std::vector<VariableInfo>& info) {
  double unit = problem.characteristic_length;
  for (std::size_t k = 0; k < info.size(); ++k) {
    const Bounds& b = problem.variables[k];
    if (!info[k].is_angle && b.low < b.high) unit = std::min(unit, 0.2 * b.high);
  }
  return unit;
}

/// A generalised golden ratio: the root of x^(n+1) = x + 1, whose powers make an evenly spread additive sequence.
double golden(int n) {
  double x = 1.5;
  for (int k = 0; k < 60; ++k) x = std::pow(1.0 + x, 1.0 / (n + 1));
  return x;
}

/// Uniform in [0, 1) from a seed and a dimension (splitmix64).
double shift(std::uint64_t seed, int dimension) {
  std::uint64_t z = (seed + 1) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(dimension) * 0xD1B54A32D192ED03ULL;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
}

int find(const std::vector<VariableInfo>& variables, const std::string& name) {
  for (std::size_t k = 0; k < variables.size(); ++k)
    if (variables[k].name == name) return static_cast<int>(k);
  return -1;
}

}  // namespace

bool serious_bound(const Problem& problem, double high) {
  return high < 1e6 * problem.characteristic_length;
}

Coordinates::Coordinates(const Problem& problem, double cap) : family_(&design_family(problem.family)) {
  const auto& info = family_->variables();
  unit_ = unit_of(problem, info);
  const auto n = static_cast<Eigen::Index>(info.size());
  fixed_.resize(n);
  x_low_.resize(n);
  x_high_.resize(n);
  for (std::size_t i = 0; i < info.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Bounds& b = problem.variables[i];
    const bool angle = info[i].is_angle, free = b.low < b.high;
    const bool cap_low = angle && free && !std::isfinite(b.low);
    const bool cap_high = free && (angle ? !std::isfinite(b.high) : !serious_bound(problem, b.high) && cap < b.high);
    x_low_[k] = !cap_low ? b.low : cap_high ? -turn : b.high - 2.0 * turn;
    x_high_[k] = !cap_high ? b.high : angle ? x_low_[k] + 2.0 * turn : cap;
    fixed_[k] = x_low_[k];
    if (!free) continue;
    free_.push_back(static_cast<int>(i));
    capped_low_.push_back(cap_low);
    capped_high_.push_back(cap_high);
  }
  low_.resize(size());
  high_.resize(size());
  for (int k = 0; k < size(); ++k) {
    low_[k] = to_y(variable(k), x_low_[variable(k)]);
    high_[k] = to_y(variable(k), x_high_[variable(k)]);
  }
  const int zp = find(info, "zp"), zs = find(info, "zs");
  const auto position = [&](int v) {
    const auto at = std::find(free_.begin(), free_.end(), v);
    return at == free_.end() ? -1 : static_cast<int>(at - free_.begin());
  };
  zp_ = position(zp);
  zs_ = position(zs);
  y_zp_ = to_y(zp, fixed_[zp]);
  y_zs_ = to_y(zs, fixed_[zs]);
  order_ = {Eigen::VectorXd::Zero(size()), -order_gap};
  if (zp_ >= 0) order_.gradient[zp_] = 1.0;
  else order_.constant += y_zp_;
  if (zs_ >= 0) order_.gradient[zs_] = -1.0;
  else order_.constant -= y_zs_;
}

double Coordinates::to_y(int variable, double x) const {
  return family_->variables()[static_cast<std::size_t>(variable)].is_angle ? x : std::asinh(x / unit_);
}

double Coordinates::to_x(int variable, double y) const {
  return family_->variables()[static_cast<std::size_t>(variable)].is_angle ? y : unit_ * std::sinh(y);
}

Eigen::VectorXd Coordinates::variables(const Eigen::VectorXd& y) const {
  Eigen::VectorXd x = fixed_;
  for (int k = 0; k < size(); ++k) {
    const int v = variable(k);
    // Exact bounds, not the round trip through asinh; a solver's rounding does not leave a side of 1e-16.
    if (y[k] <= low_[k] + snap) x[v] = x_low_[v];
    else if (y[k] >= high_[k] - snap) x[v] = x_high_[v];
    else x[v] = std::clamp(to_x(v, y[k]), x_low_[v], x_high_[v]);
  }
  return x;
}

Eigen::VectorXd Coordinates::coordinates(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y(size());
  for (int k = 0; k < size(); ++k) y[k] = std::clamp(to_y(variable(k), x[variable(k)]), low_[k], high_[k]);
  return y;
}

Eigen::VectorXd Coordinates::slopes(const Eigen::VectorXd& x) const {
  Eigen::VectorXd out(size());
  for (int k = 0; k < size(); ++k)
    out[k] =
        family_->variables()[static_cast<std::size_t>(variable(k))].is_angle ? 1.0 : std::hypot(unit_, x[variable(k)]);
  return out;
}

Eigen::VectorXd Coordinates::start(int index, std::uint64_t seed) const {
  const double ratio = golden(size());
  Eigen::VectorXd u(size());
  double step = 1.0;
  for (int k = 0; k < size(); ++k) {
    step /= ratio;
    const double t = shift(seed, k) + (index + 1.0) * step;
    u[k] = t - std::floor(t);
  }
  Eigen::VectorXd y = low_ + u.cwiseProduct(high_ - low_);
  // Draw zp above the least zs, then zs below zp.
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
  return y;
}

}  // namespace ninedof
