#pragma once
/// The checker's numbers over a box of designs and poses: c + sum of a_k t_k, off by at most r, for all t_k from -1 to
/// 1. Every error of rounding is in r. A number of which nothing is known has r = NaN, and passes no test.

#include <array>

#include "proof/checker/curves.hpp"

namespace ninedof::checker {

/// Six symbols of a pose, then six of a design.
constexpr std::size_t pose_symbols = 6, most_varied_symbols = 6, symbols = pose_symbols + most_varied_symbols;

struct Linear {
  double c = 0.0, r = 0.0;
  std::array<double, symbols> a{};
  constexpr Linear() = default;
  constexpr Linear(double x) : c(x) {}  // NOLINT: numbers mix freely
  constexpr Linear(double x, double error) : c(x), r(error) {}
};

namespace grain {
constexpr double of_sum = 0x1p-52, of_product = 0x1p-48, of_curve = 0x1p-46, up = 1.0 + 0x1p-44;
constexpr double least = 1e-300;  ///< more than what products below the normal doubles lose
}  // namespace grain

inline Linear unknown_number() {
  return {0.0, std::numeric_limits<double>::quiet_NaN()};
}
inline double swing(const Linear& x) {
  double sum = 0.0;
  for (const double a : x.a) sum += std::abs(a);
  return sum * grain::up;
}
inline double lower_end(const Linear& x) {
  return x.c - (swing(x) + x.r) * grain::up - grain::of_product * std::abs(x.c);
}
inline double upper_end(const Linear& x) {
  return x.c + (swing(x) + x.r) * grain::up + grain::of_product * std::abs(x.c);
}

/// From low to high along a symbol.
inline Linear along(double low, double high, std::size_t symbol) {
  Linear out(std::clamp(0.5 * low + 0.5 * high, low, high));
  if (low < high) out.a[symbol] = std::max(up(high - out.c), up(out.c - low));
  return out;
}

inline Linear operator+(const Linear& x, const Linear& y) {
  Linear out(x.c + y.c);
  for (std::size_t k = 0; k < symbols; ++k) out.a[k] = x.a[k] + y.a[k];
  out.r = (x.r + y.r + grain::of_sum * (std::abs(out.c) + swing(out))) * grain::up;
  return out;
}
inline Linear operator-(const Linear& x) {
  Linear out(-x.c, x.r);
  for (std::size_t k = 0; k < symbols; ++k) out.a[k] = -x.a[k];
  return out;
}
inline Linear operator-(const Linear& x, const Linear& y) {
  return x + (-y);
}
inline Linear operator*(double s, const Linear& x) {
  Linear out(s * x.c);
  for (std::size_t k = 0; k < symbols; ++k) out.a[k] = s * x.a[k];
  out.r = (std::abs(s) * x.r + grain::of_sum * (std::abs(out.c) + swing(out)) + grain::least) * grain::up;
  return out;
}
/// Squares of symbols are from 0 to 1: half of their factors counts as known.
inline Linear operator*(const Linear& x, const Linear& y) {
  Linear out;
  double squares = 0.0, moduli = 0.0;
  for (std::size_t k = 0; k < symbols; ++k) {
    const double both = x.a[k] * y.a[k];
    squares += both;
    moduli += std::abs(both);
    out.a[k] = x.c * y.a[k] + y.c * x.a[k];
  }
  out.c = x.c * y.c + 0.5 * squares;
  const double sx = swing(x), sy = swing(y), all_x = std::abs(x.c) + sx, all_y = std::abs(y.c) + sy;
  out.r = (std::max(sx * sy - 0.5 * moduli, 0.0) + all_x * y.r + all_y * x.r + x.r * y.r +
           grain::of_product * (all_x * all_y) + grain::least) *
          grain::up;
  return out;
}

/// f(x) by its tangent at x.c, where f has this value and slope; its second derivative is within `bend` wherever x is.
inline Linear bent(const Linear& x, double value, double slope, Range bend) {
  const double h = (swing(x) + x.r) * grain::up, half = 0.5 * h * h * grain::up;
  const double low = std::min(bend.a, 0.0) * half, high = std::max(bend.b, 0.0) * half;
  Linear out(value + 0.5 * (low + high));
  for (std::size_t k = 0; k < symbols; ++k) out.a[k] = slope * x.a[k];
  out.r = (std::abs(slope) * x.r + 0.5 * (high - low) +
           grain::of_curve * (std::abs(value) + std::abs(slope) * h + high - low) + grain::least) *
          grain::up;
  return out;
}
inline Linear inverse(const Linear& x) {
  const double low = lower_end(x);
  if (!(low > 0.0)) return unknown_number();
  return bent(x, 1.0 / x.c, -1.0 / (x.c * x.c), {0.0, 2.0 / (low * low * low) * grain::up});
}
inline Linear inverse_root(const Linear& x) {
  const double low = lower_end(x);
  if (!(low > 0.0)) return unknown_number();
  const double y = 1.0 / std::sqrt(x.c);
  return bent(x, y, -0.5 * y / x.c, {0.0, 0.75 / (low * low * std::sqrt(low)) * grain::up});
}
inline Linear square_root(const Linear& x) {
  const double low = lower_end(x);
  if (!(low > 0.0)) return unknown_number();
  const double y = std::sqrt(x.c);
  return bent(x, y, 0.5 / y, {-0.25 / (low * std::sqrt(low)) * grain::up, 0.0});
}
/// The same with a value and a slope that are known up to their ranges.
inline Linear waved(const Linear& x, Range value, Range slope) {
  Linear out = bent(x, 0.5 * (value.a + value.b), 0.5 * (slope.a + slope.b), {-1.0, 1.0});
  const double h = (swing(x) + x.r) * grain::up;
  out.r = (out.r + (value.b - value.a) + (slope.b - slope.a) * h) * grain::up;
  return out;
}
inline Linear sine(const Linear& x) {
  const OnCircle at = sine_cosine(x.c);
  return waved(x, at.sine, at.cosine);
}
inline Linear cosine(const Linear& x) {
  const OnCircle at = sine_cosine(x.c);
  return waved(x, at.cosine, -at.sine);
}

/// sin(v)/v (shift 1) and (1 - cos v)/v^2 (shift 2) of u = v^2, by their series sum of (-u)^n / (2n + shift)!. Their
/// second derivatives fall from 1/60 and 1/360 at 0, and are positive up to v = 5.7; here v is little more than pi at
/// most.
inline Linear of_angle_squared(const Linear& u, int shift) {
  if (!(lower_end(u) > -1.0 && upper_end(u) < 12.0)) return unknown_number();
  double term = 1.0 / shift, value = term, slope = 0.0;
  for (int n = 1; n < 40; ++n) {  // the terms of the slope come before those of the value are multiplied by u
    term /= -(2.0 * n + shift - 1.0) * (2.0 * n + shift);
    slope += n * term;
    term *= u.c;
    value += term;
  }
  Linear out = bent(u, value, slope, {0.0, shift == 1 ? 0.018 : 0.003});
  out.r += grain::of_curve;
  return out;
}

struct Arrow {
  Linear x, y, z;
};
inline Arrow operator+(const Arrow& v, const Arrow& w) {
  return {v.x + w.x, v.y + w.y, v.z + w.z};
}
inline Arrow operator-(const Arrow& v, const Arrow& w) {
  return {v.x - w.x, v.y - w.y, v.z - w.z};
}
inline Arrow operator*(const Linear& s, const Arrow& v) {
  return {s * v.x, s * v.y, s * v.z};
}
inline Linear dot(const Arrow& v, const Arrow& w) {
  return v.x * w.x + v.y * w.y + v.z * w.z;
}
inline Arrow cross(const Arrow& v, const Arrow& w) {
  return {v.y * w.z - v.z * w.y, v.z * w.x - v.x * w.z, v.x * w.y - v.y * w.x};
}
inline Arrow unit(const Arrow& v) {
  return inverse_root(dot(v, v)) * v;
}

}  // namespace ninedof::checker
