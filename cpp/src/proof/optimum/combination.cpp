#include "proof/optimum/combination.hpp"

#include <cmath>

#include "math/numbers.hpp"

namespace ninedof::proof {
namespace {

/// A row, or the quotient of two legs, of which the combination takes a share.
struct Column {
  std::size_t plus = rows, minus = rows;  ///< the row that it adds and the one that it subtracts; `rows` for none
  double gain = 0.0;                      ///< at the middle, less what the widths of its slopes can take away
  std::array<double, coordinates> slope{};
};

constexpr std::size_t most_columns = 10, most_lines = coordinates + 2;

Column column(std::size_t plus, std::size_t minus, const Values& at_middle, const std::array<Slopes, rows>& slopes,
              const Radii& radius, std::size_t dimension) {
  Column out{plus, minus};
  const auto add = [&](std::size_t row, double sign) {
    if (row == rows) return;
    out.gain += sign * middle(at_middle[row]);
    for (std::size_t k = 0; k < dimension; ++k) {
      out.gain -= 0.5 * radius[k] * width(slopes[row][k]);
      out.slope[k] += sign * middle(slopes[row][k]);
    }
  };
  add(plus, 1.0);
  add(minus, -1.0);
  return out;
}

/// Maximizes sum gain_j x_j - sum_k radius_k |sum_j slope_jk x_j| over x >= 0 where the shares of the two greatest
/// singular values (columns 0, 1) add to 1 and those of the two least (columns 2, 3) as well. Each modulus is a
/// pair of variables u - v of which one is zero; a tableau holds the columns of x and u, those of v being -u.
class Simplex {
 public:
  Simplex(const std::array<Column, most_columns>& columns, std::size_t count, const Radii& radius,
          std::size_t dimension)
      : columns_(columns), count_(count), radius_(radius), dimension_(dimension) {
    start();
  }

  std::array<double, most_columns> solve() {
    constexpr int most_pivots = 60;  // far above what any box took; a worse combination is no error
    for (int i = 0; i < most_pivots && step(); ++i) {
    }
    std::array<double, most_columns> x{};
    for (std::size_t line = 0; line < lines(); ++line)
      if (basic_[line] < count_) x[basic_[line]] = std::max(table_[line][last()], 0.0);
    return x;
  }

 private:
  std::size_t lines() const { return dimension_ + 2; }
  std::size_t last() const { return count_ + dimension_; }

  /// The best pair of single rows, and u or v by the sign of each slope.
  void start() {
    std::size_t a = 0, b = 2;
    double best = -1e300;
    for (std::size_t i : {0, 1})
      for (std::size_t j : {2, 3}) {
        double value = columns_[i].gain + columns_[j].gain;
        for (std::size_t k = 0; k < dimension_; ++k)
          value -= radius_[k] * std::abs(columns_[i].slope[k] + columns_[j].slope[k]);
        if (value > best) best = value, a = i, b = j;
      }
    for (std::size_t k = 0; k < dimension_; ++k) {
      Line& line = table_[k];
      const double sum = columns_[a].slope[k] + columns_[b].slope[k], sign = sum >= 0.0 ? -1.0 : 1.0;
      for (std::size_t j = 0; j < count_; ++j) {
        const double from = j < 2 ? columns_[a].slope[k] : j < 4 ? columns_[b].slope[k] : 0.0;
        line[j] = sign * (columns_[j].slope[k] - from);
      }
      line[count_ + k] = -sign;
      line[last()] = std::abs(sum);
      basic_[k] = count_ + k;
    }
    for (std::size_t j = 0; j < 2; ++j) table_[dimension_][j] = table_[dimension_ + 1][j + 2] = 1.0;
    table_[dimension_][last()] = table_[dimension_ + 1][last()] = 1.0;
    basic_[dimension_] = a;
    basic_[dimension_ + 1] = b;
    for (std::size_t j = 0; j <= last(); ++j) {
      double price = 0.0;
      for (std::size_t line = 0; line < lines(); ++line) price += cost(basic_[line]) * table_[line][j];
      price_[j] = price;
    }
  }

  double cost(std::size_t j) const { return j < count_ ? columns_[j].gain : -radius_[j - count_]; }

  bool step() {
    // The entering column: x, u, or v (the column of u with the other sign).
    double gain = 1e-13;
    std::size_t in = last();
    bool turn = false;
    for (std::size_t j = 0; j < last(); ++j) {
      const double d = cost(j) - price_[j];
      if (d > gain) gain = d, in = j, turn = false;
      if (j < count_) continue;
      const double other = cost(j) + price_[j];
      if (other > gain) gain = other, in = j, turn = true;
    }
    if (in == last()) return false;
    const double sign = turn ? -1.0 : 1.0;
    std::size_t out = lines();
    double least = 1e300;
    for (std::size_t line = 0; line < lines(); ++line) {
      const double entry = sign * table_[line][in];
      if (entry > 1e-11 && table_[line][last()] < least * entry) least = table_[line][last()] / entry, out = line;
    }
    if (out == lines()) return false;
    Line& pivot = table_[out];
    const double scale = 1.0 / (sign * pivot[in]);
    for (std::size_t j = 0; j <= last(); ++j) pivot[j] *= scale;
    for (std::size_t line = 0; line < lines(); ++line) {
      if (line == out) continue;
      const double factor = sign * table_[line][in];
      for (std::size_t j = 0; j <= last(); ++j) table_[line][j] -= factor * pivot[j];
    }
    for (std::size_t j = 0; j <= last(); ++j) price_[j] += gain * pivot[j];
    basic_[out] = in;
    return true;
  }

  const std::array<Column, most_columns>& columns_;
  std::size_t count_;
  const Radii& radius_;
  std::size_t dimension_;
  using Line = std::array<double, most_columns + coordinates + 1>;
  std::array<Line, most_lines> table_{};
  Line price_{};
  std::array<std::size_t, most_lines> basic_{};
};

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
  const auto make = [&](std::size_t plus, std::size_t minus) {
    return column(plus, minus, at_middle, slopes, radius, dimension);
  };
  std::array<Column, most_columns> columns{make(axial_max, rows), make(transverse_max, rows), make(rows, axial_min),
                                           make(rows, transverse_min)};
  std::size_t count = 4;
  if (log_leg_ratio < infinity)
    for (std::size_t i = external_leg; i < rows; ++i)
      for (std::size_t j = external_leg; j < rows; ++j) {
        if (i == j) continue;
        columns[count] = make(i, j);
        columns[count++].gain -= log_leg_ratio;
      }
  const std::array<double, most_columns> x = Simplex(columns, count, radius, dimension).solve();
  std::array<double, rows> weight{};
  for (std::size_t j = 0; j < count; ++j) {
    if (columns[j].plus != rows) weight[columns[j].plus] += x[j];
    if (columns[j].minus != rows) weight[columns[j].minus] -= x[j];
  }
  const auto share = [](double w) { return static_cast<float>(std::clamp(w, 0.0, 1.0)); };
  return {share(weight[transverse_max]), share(-weight[transverse_min]), static_cast<float>(weight[external_leg]),
          static_cast<float>(weight[upper_leg])};
}

}  // namespace ninedof::proof
