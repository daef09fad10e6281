#include "redundancy/search/cubic.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof {
namespace {

double value(const std::array<double, 4>& c, double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

/// Zeros of the derivative, ascending; NaN where there is none.
std::array<double, 2> turning_points(const std::array<double, 4>& c) {
  const double a = 3.0 * c[3], half = c[2], b = c[1];  // a t^2 + 2 half t + b
  const double root = std::sqrt(half * half - a * b);
  const double sum = -(half + std::copysign(root, half));
  const double one = sum / a, other = b / sum;
  return {std::min(one, other), std::max(one, other)};
}

/// The zero in (low, high] of a cubic that is monotone there and changes sign: bisection down to neighbouring numbers.
double between(const std::array<double, 4>& c, double low, double high) {
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (value(c, middle) * c[0] > 0.0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

double first_zero(const std::array<double, 4>& c, double most) {
  double from = 0.0;
  const auto turns = turning_points(c);
  for (const double to : {turns[0], turns[1], most}) {
    if (!(to > from) || to > most) continue;
    if (!(value(c, to) * c[0] > 0.0)) return between(c, from, to);
    from = to;
  }
  return most;
}

}  // namespace ninedof
