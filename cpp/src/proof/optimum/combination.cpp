#include "proof/optimum/combination.hpp"

#include <algorithm>
#include <cmath>

#include "proof/optimum/mixture_simplex.hpp"

namespace ninedof::proof {
namespace {

/// A row, its reciprocal, or the quotient of two, of which the combination takes a share.
struct RowShare {
  std::size_t plus = rows, minus = rows;  ///< the row that it adds and the one that it subtracts; `rows` for none
  double bound = 0.0;                     ///< which the limits hold it to
};

constexpr std::size_t most_columns = 10 + 2 * sizes;
using RowColumn = MixtureColumn<coordinates>;

/// Its gain at the middle, less what the widths of its slopes can take away.
RowColumn column(const RowShare& part, const Values& at_middle, const std::array<Slopes, rows>& slopes,
                 const Radii& radius, std::size_t dimension) {
  RowColumn out;
  out.gain = -part.bound;
  const auto add = [&](std::size_t row, double sign) {
    if (row == rows) return;
    out.gain += sign * middle(at_middle[row]);
    for (std::size_t k = 0; k < dimension; ++k) {
      out.gain -= 0.5 * radius[k] * width(slopes[row][k]);
      out.slope[k] += sign * middle(slopes[row][k]);
    }
  };
  add(part.plus, 1.0);
  add(part.minus, -1.0);
  return out;
}

/// The rows, and all that the limits hold to a bound.
std::size_t shares_of(const RowLimits& limits, std::array<RowShare, most_columns>& parts) {
  parts = {{{axial_max, rows}, {transverse_max, rows}, {rows, axial_min}, {rows, transverse_min}}};
  std::size_t count = 4;
  if (limits.log_leg_ratio < infinity)
    for (std::size_t i = external_leg; i < first_size; ++i)
      for (std::size_t j = external_leg; j < first_size; ++j)
        if (i != j) parts[count++] = {i, j, limits.log_leg_ratio};
  for (std::size_t i = 0; i < sizes; ++i) {
    const Interval& size = limits.size[i];
    if (size.hi < infinity) parts[count++] = {first_size + i, rows, middle(log(Interval(size.hi)))};
    if (size.lo > 0.0) parts[count++] = {rows, first_size + i, -middle(log(Interval(size.lo)))};
  }
  return count;
}

}  // namespace

bool Combination::limited() const {
  return std::ranges::any_of(limits, [](float w) { return w != 0.0F; });
}
bool Combination::legs() const {
  return limits[0] != 0.0F || limits[1] != 0.0F;
}

std::array<Interval, rows> Combination::weights() const {
  const Interval a(max), b(min), e(limits[0]), u(limits[1]);
  std::array<Interval, rows> out{1.0 - a, b - 1.0, a, -b, e, u, legs() ? -(e + u) : Interval(0.0)};
  for (std::size_t i = 0; i < sizes; ++i) out[first_size + i] = limits[2 + i];
  return out;
}

Interval Combination::held(const RowLimits& by) const {
  Interval out(0.0);
  const Interval zero(0.0), e(limits[0]), u(limits[1]);
  using ninedof::max;
  if (legs()) out = (max(e, zero) + max(u, zero) + max(-(e + u), zero)) * by.log_leg_ratio;
  for (std::size_t i = 0; i < sizes; ++i) {
    const float w = limits[2 + i];
    if (w != 0.0F) out += Interval(w) * log(Interval(w > 0.0F ? by.size[i].hi : by.size[i].lo));
  }
  return out;
}

Interval combined(const Combination& by, const Values& at_middle, const std::array<Slopes, rows>& slopes,
                  const Radii& radius, std::size_t dimension, const RowLimits& limits) {
  const std::array<Interval, rows> weight = by.weights();
  std::array<std::size_t, rows> used;
  std::size_t count = 0;
  Interval value = -by.held(limits);
  for (std::size_t i = 0; i < rows; ++i) {
    if (weight[i].lo == 0.0 && weight[i].hi == 0.0) continue;
    used[count++] = i;
    value += weight[i] * at_middle[i];
  }
  double loss = 0.0;
  for (std::size_t k = 0; k < dimension; ++k) {
    Interval slope(0.0);
    for (std::size_t i = 0; i < count; ++i) slope += weight[used[i]] * slopes[used[i]][k];
    loss = (loss + Interval(magnitude(slope)) * radius[k]).hi;
  }
  return value - loss;
}

Combination best_combination(const Values& at_middle, const std::array<Slopes, rows>& slopes, const Radii& radius,
                             std::size_t dimension, const RowLimits& limits) {
  std::array<RowShare, most_columns> parts;
  const std::size_t count = shares_of(limits, parts);
  std::array<RowColumn, most_columns> columns;
  for (std::size_t j = 0; j < count; ++j) columns[j] = column(parts[j], at_middle, slopes, radius, dimension);
  const std::array<double, most_columns> x =
      MixtureSimplex<2, most_columns, coordinates>(columns, count, radius, dimension).solve(infinity);
  std::array<double, rows> weight{};
  for (std::size_t j = 0; j < count; ++j) {
    if (parts[j].plus != rows) weight[parts[j].plus] += x[j];
    if (parts[j].minus != rows) weight[parts[j].minus] -= x[j];
  }
  const auto share = [](double w) { return static_cast<float>(std::clamp(w, 0.0, 1.0)); };
  Combination out{share(weight[transverse_max]), share(-weight[transverse_min]), {}};
  out.limits = {static_cast<float>(weight[external_leg]), static_cast<float>(weight[upper_leg])};
  for (std::size_t i = 0; i < sizes; ++i) out.limits[2 + i] = static_cast<float>(weight[first_size + i]);
  return out;
}

}  // namespace ninedof::proof
