#include "proof/optimum/combination.hpp"

#include <cmath>

#include "math/numbers.hpp"
#include "proof/optimum/mixture_simplex.hpp"

namespace ninedof::proof {
namespace {

/// A row, or the quotient of two legs, of which the combination takes a share.
struct RowShare {
  std::size_t plus = rows, minus = rows;  ///< the row that it adds and the one that it subtracts; `rows` for none
};

constexpr std::size_t most_columns = 10;
using RowColumn = MixtureColumn<coordinates>;

/// Its gain at the middle, less what the widths of its slopes can take away.
RowColumn column(const RowShare& part, const Values& at_middle, const std::array<Slopes, rows>& slopes,
                 const Radii& radius, std::size_t dimension) {
  RowColumn out;
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

}  // namespace

std::array<Interval, rows> Combination::weights() const {
  const Interval a(max), b(min), e(external), u(upper);
  return {1.0 - a, b - 1.0, a, -b, e, u, -(e + u)};
}

Interval Combination::spread() const {
  const Interval zero(0.0), e(external), u(upper);
  using ninedof::max;
  return max(e, zero) + max(u, zero) + max(-(e + u), zero);
}

Interval combined(const Combination& by, const Values& at_middle, const std::array<Slopes, rows>& slopes,
                  const Radii& radius, std::size_t dimension, double log_leg_ratio) {
  const std::array<Interval, rows> weight = by.weights();
  const bool legs = by.external != 0.0F || by.upper != 0.0F;
  const std::size_t used = legs ? rows : external_leg;
  Interval value = legs ? -(by.spread() * log_leg_ratio) : Interval(0.0);
  for (std::size_t i = 0; i < used; ++i) value += weight[i] * at_middle[i];
  double loss = 0.0;
  for (std::size_t k = 0; k < dimension; ++k) {
    Interval slope(0.0);
    for (std::size_t i = 0; i < used; ++i) slope += weight[i] * slopes[i][k];
    loss = (loss + Interval(magnitude(slope)) * radius[k]).hi;
  }
  return value - loss;
}

Combination best_combination(const Values& at_middle, const std::array<Slopes, rows>& slopes, const Radii& radius,
                             std::size_t dimension, double log_leg_ratio) {
  std::array<RowShare, most_columns> parts{
      {{axial_max, rows}, {transverse_max, rows}, {rows, axial_min}, {rows, transverse_min}}};
  std::array<RowColumn, most_columns> columns{};
  std::size_t count = 0;
  for (; count < 4; ++count) columns[count] = column(parts[count], at_middle, slopes, radius, dimension);
  if (log_leg_ratio < infinity)
    for (std::size_t i = external_leg; i < rows; ++i)
      for (std::size_t j = external_leg; j < rows; ++j) {
        if (i == j) continue;
        parts[count] = {i, j};
        columns[count] = column(parts[count], at_middle, slopes, radius, dimension);
        columns[count++].gain -= log_leg_ratio;
      }
  const std::array<double, most_columns> x =
      MixtureSimplex<2, most_columns, coordinates>(columns, count, radius, dimension).solve(infinity);
  std::array<double, rows> weight{};
  for (std::size_t j = 0; j < count; ++j) {
    if (parts[j].plus != rows) weight[parts[j].plus] += x[j];
    if (parts[j].minus != rows) weight[parts[j].minus] -= x[j];
  }
  const auto share = [](double w) { return static_cast<float>(std::clamp(w, 0.0, 1.0)); };
  return {share(weight[transverse_max]), share(-weight[transverse_min]), static_cast<float>(weight[external_leg]),
          static_cast<float>(weight[upper_leg])};
}

}  // namespace ninedof::proof
