#pragma once
/// The best mixture of linear functions over a box: a small linear program, by the simplex method in plain doubles.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace ninedof::proof {

/// A function of which the mixture takes a share: its gain, and its slopes.
template <std::size_t Dimensions>
struct MixtureColumn {
  double gain = 0.0;
  std::array<double, Dimensions> slope{};
};

/// Maximizes sum gain_j x_j - sum_k radius_k |sum_j slope_jk x_j| over x >= 0 where the shares of the first `Group`
/// columns add to 1 and those of the next `Group` as well. Each modulus is a pair of variables u - v of which one is
/// zero; a tableau holds the columns of x and u, those of v being -u.
template <std::size_t Group, std::size_t Columns, std::size_t Dimensions>
class MixtureSimplex {
 public:
  using Column = MixtureColumn<Dimensions>;

  MixtureSimplex(const std::array<Column, Columns>& columns, std::size_t count,
                 const std::array<double, Dimensions>& radius, std::size_t dimension)
      : columns_(columns), count_(count), radius_(radius), dimension_(dimension) {
    start();
  }

  /// Ends where the value exceeds `enough`.
  std::array<double, Columns> solve(double enough) {
    constexpr int most_pivots = 60;  // far above what any box took; a worse combination is no error
    for (int i = 0; i < most_pivots && value() <= enough && step(); ++i) {
    }
    std::array<double, Columns> x{};
    for (std::size_t line = 0; line < lines(); ++line)
      if (basic_[line] < count_) x[basic_[line]] = std::max(table_[line][last()], 0.0);
    return x;
  }
  double value() const { return price_[last()]; }

 private:
  std::size_t lines() const { return dimension_ + 2; }
  std::size_t last() const { return count_ + dimension_; }

  /// The best pair of single columns, and u or v by the sign of each slope.
  void start() {
    std::size_t a = 0, b = Group;
    double best = -1e300;
    for (std::size_t i = 0; i < Group; ++i)
      for (std::size_t j = Group; j < 2 * Group; ++j) {
        double value = columns_[i].gain + columns_[j].gain;
        for (std::size_t k = 0; k < dimension_; ++k)
          value -= radius_[k] * std::abs(columns_[i].slope[k] + columns_[j].slope[k]);
        if (value > best) best = value, a = i, b = j;
      }
    for (std::size_t k = 0; k < lines(); ++k) std::fill_n(table_[k].begin(), last() + 1, 0.0);
    for (std::size_t k = 0; k < dimension_; ++k) {
      Line& line = table_[k];
      const double sum = columns_[a].slope[k] + columns_[b].slope[k], sign = sum >= 0.0 ? -1.0 : 1.0;
      for (std::size_t j = 0; j < count_; ++j) {
        const double from = j < Group ? columns_[a].slope[k] : j < 2 * Group ? columns_[b].slope[k] : 0.0;
        line[j] = sign * (columns_[j].slope[k] - from);
      }
      line[count_ + k] = -sign;
      line[last()] = std::abs(sum);
      basic_[k] = count_ + k;
    }
    for (std::size_t j = 0; j < Group; ++j) table_[dimension_][j] = table_[dimension_ + 1][j + Group] = 1.0;
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
      const double factor = sign * table_[line][in];
      if (line == out || factor == 0.0) continue;
      for (std::size_t j = 0; j <= last(); ++j) table_[line][j] -= factor * pivot[j];
    }
    for (std::size_t j = 0; j <= last(); ++j) price_[j] += gain * pivot[j];
    basic_[out] = in;
    return true;
  }

  const std::array<Column, Columns>& columns_;
  std::size_t count_;
  const std::array<double, Dimensions>& radius_;
  std::size_t dimension_;
  using Line = std::array<double, Columns + Dimensions + 1>;
  std::array<Line, Dimensions + 2> table_;  // of what a box uses
  Line price_;
  std::array<std::size_t, Dimensions + 2> basic_{};
};

}  // namespace ninedof::proof
