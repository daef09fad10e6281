#include "math/roots/circle_roots.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof {
namespace {

constexpr int degree = 8;
constexpr std::array<double, 9> inverse_binomial{1.0,        1.0 / 8.0,  1.0 / 28.0, 1.0 / 56.0, 1.0 / 70.0,
                                                 1.0 / 56.0, 1.0 / 28.0, 1.0 / 8.0,  1.0};
constexpr int most_halvings = 20;     // roots closer than 1e-6 count as a double root
constexpr double noise = 1e-13;       // relative to the largest coefficient: error after cancellation
constexpr int most_refinements = 40;  // four or five suffice

/// Bernstein coefficients on an interval [from, from + size] of [0, 1].
struct Piece {
  Octic b;
  double from, size;
  int halvings;
};

int sign_changes(const Octic& b) {
  int changes = 0;
  for (std::size_t k = 0; k < degree; ++k) changes += static_cast<int>(std::signbit(b[k]) != std::signbit(b[k + 1]));
  return changes;
}

double largest_of(const Octic& b) {
  double largest = 0.0;
  for (const double x : b) largest = std::max(largest, std::abs(x));
  return largest;
}

/// Whether the signs are unreliable: no coefficient exceeds the noise, or a double root may lie on an end of the
/// interval, where value and slope are both noise and neither of the two neighbouring pieces would show it.
bool in_noise(const Octic& b, double level) {
  const double largest = largest_of(b);
  if (largest <= level) return true;
  const auto touches = [&](double end, double next) {
    return std::abs(end) <= level && next * next <= level * largest;
  };
  return touches(b[0], b[1]) || touches(b[degree], b[degree - 1]);
}

/// De Casteljau subdivision at the middle, by sums and exact powers of two: returns the left half, b keeps the right.
Octic split_left(Octic& b) {
  Octic left;
  double scale = 1.0;
  left[0] = b[0];
  for (std::size_t level = 1; level <= degree; ++level) {
    for (std::size_t k = 0; k <= degree - level; ++k) b[k] += b[k + 1];
    scale *= 0.5;
    left[level] = scale * b[0];
  }
  // b[k] now holds the right coefficient k times 2^(8 - k).
  for (std::size_t k = 0; k < degree; ++k) b[k] *= 1.0 / static_cast<double>(1 << (degree - k));
  return left;
}

struct ValueSlope {
  double value, slope;
};

ValueSlope horner(const Octic& p, double x) {
  double value = p[degree], slope = 0.0;
  for (std::size_t k = degree; k-- > 0;) {
    slope = slope * x + value;
    value = value * x + p[k];
  }
  return {value, slope};
}

/// The only sign change of p in [low, high], from `start`: Newton's method, or bisection where a step leaves them.
double refine(const Octic& p, double low, double high, double start, bool negative_below) {
  double x = start;
  for (int k = 0; k < most_refinements; ++k) {
    const auto [value, slope] = horner(p, x);
    if ((value < 0.0) == negative_below) low = x;
    else high = x;
    double next = x - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::abs(next - x);
    x = next;
    if (step < root_accuracy) break;  // the error after a Newton step is of the order of the squared step
  }
  return x;
}

}  // namespace

CircleRoots circle_roots(const Octic& p, double error) {
  CircleRoots out;
  const double largest = largest_of(p);
  if (!(largest > error) || !std::isfinite(largest)) {
    out.certain = false;
    return out;
  }
  const double level = std::max(noise * largest, error);
  // x in (0, infinity) maps to u = x / (1 + x) in (0, 1), where the coefficients over the binomials are the Bernstein
  // coefficients; for negative x odd ones are negated. Pieces below u = 1/2 are refined in x, others in 1 / x.
  for (const double sign : {1.0, -1.0}) {
    Octic forward = p, backward;
    for (std::size_t k = 1; k <= degree; k += 2) forward[k] *= sign;
    for (std::size_t k = 0; k <= degree; ++k) backward[k] = forward[degree - k];
    std::array<Piece, most_halvings + 2> stack;
    std::size_t height = 1;
    stack[0] = {forward, 0.0, 1.0, 0};
    for (std::size_t k = 0; k <= degree; ++k) stack[0].b[k] *= inverse_binomial[k];
    while (height > 0) {
      Piece piece = stack[--height];
      const int changes = sign_changes(piece.b);
      if (changes == 0 || changes == 1) {
        if (in_noise(piece.b, level)) out.certain = false;
        if (changes == 0) continue;
        if (piece.halvings > 0) {
          if (out.count == degree) {
            out.certain = false;
            return out;
          }
          const double to = piece.from + piece.size;
          // The line through the two neighbouring coefficients of different sign crosses zero here.
          std::size_t k = 0;
          while (std::signbit(piece.b[k]) == std::signbit(piece.b[k + 1])) ++k;
          const double guess =
              piece.from + piece.size / 8.0 * (static_cast<double>(k) + piece.b[k] / (piece.b[k] - piece.b[k + 1]));
          const bool below = std::signbit(piece.b[0]);
          if (to <= 0.5) {
            const double x =
                refine(forward, piece.from / (1.0 - piece.from), to / (1.0 - to), guess / (1.0 - guess), below);
            out.root[static_cast<std::size_t>(out.count++)] = {sign * x, 1.0};
          } else {
            const double x =
                refine(backward, (1.0 - to) / to, (1.0 - piece.from) / piece.from, (1.0 - guess) / guess, !below);
            out.root[static_cast<std::size_t>(out.count++)] = {sign, x};
          }
          continue;
        }
      }
      if (piece.halvings == most_halvings) {
        out.certain = false;
        continue;
      }
      Piece& right = stack[height];
      right = piece;
      const Octic left = split_left(right.b);
      right.size = 0.5 * piece.size;
      right.from = piece.from + right.size;
      ++right.halvings;
      stack[height + 1] = {left, piece.from, right.size, right.halvings};
      height += 2;
    }
  }
  return out;
}

}  // namespace ninedof
