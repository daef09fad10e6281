#pragma once
/// Numbers over a box as linear forms with an error: c + a_1 t_1 + ... + a_N t_N + d with |d| <= r, where the t_k go
/// from -1 to 1 through the box: N = 6 for boxes of poses.
///
/// Each operation keeps what is linear in the box and adds the rest, which is of second order, to r (affine
/// arithmetic). Bounds then err by the square of the size of the box, as those of mean-value forms do, at a fraction
/// of their cost. Every rounding is added to r: a sum of up to thirty terms computed in the ordinary way errs by less
/// than 32 units of 2^-53 of the sum of their moduli. An error that is infinite or NaN says that nothing is known.

#include <array>
#include <cmath>
#include <limits>

#include "math/elementary.hpp"
#include "ninedof/math/interval.hpp"

namespace ninedof {

namespace forms {

inline constexpr double grain = 0x1p-48;  // 32 units of 2^-53
inline constexpr double tiny = 1e-300;    // more than underflow loses in one operation

/// The sum over k of (-u)^k / (2k + first)! and its derivative, for u from 0 to 2 pi^2: what follows the last term is
/// below 1e-30, and roundings are below 2^-46.
struct Series {
  double value, slope;
};
Series series(double u, int first);

}  // namespace forms

/// Forms of degree 2 keep the products t_k t_l with k >= l as well: c + a . t + q . (t t) + d.
template <std::size_t N, int Degree = 1>
struct Form {
  static constexpr std::size_t size = N;
  static constexpr bool curved = Degree == 2;

  double c = 0.0;
  std::array<double, N> a{};
  [[no_unique_address]] std::array<double, curved ? N * (N + 1) / 2 : 0> q{};  ///< row after row
  double r = 0.0;

  Form() = default;
  Form(double constant) : c(constant) {}  // NOLINT: numbers mix freely with forms in formulas
  template <int Lower>
    requires(Lower < Degree)
  explicit Form(const Form<N, Lower>& x) : c(x.c), a(x.a), r(x.r) {}

  /// Any number of an interval.
  static Form of(const Interval& x) {
    Form out(middle(x));
    out.r = detail::above(std::max(x.hi - out.c, out.c - x.lo));
    return out;
  }
  /// x = coordinate k of the box, from low to high.
  static Form coordinate(double low, double high, std::size_t k) {
    if (low == high) return low;
    Form out(0.5 * (low + high));
    out.a[k] = 0.5 * (high - low);
    out.r = 0x1p-50 * (std::abs(low) + std::abs(high));
    return out;
  }
  static Form unknown() {
    Form out;
    out.r = std::numeric_limits<double>::infinity();
    return out;
  }

  // Friends, so that doubles mix with forms.

  friend Form operator-(Form x) {
    x.c = -x.c;
    for (double& slope : x.a) slope = -slope;
    for (double& bend : x.q) bend = -bend;
    return x;
  }
  friend Form operator+(const Form& x, const Form& y) {
    Form out(x.c + y.c);
    for (std::size_t k = 0; k < N; ++k) out.a[k] = x.a[k] + y.a[k];
    for (std::size_t n = 0; n < out.q.size(); ++n) out.q[n] = x.q[n] + y.q[n];
    out.r = (x.r + y.r + forms::grain * (std::abs(out.c) + spread(out))) * (1.0 + forms::grain);
    return out;
  }
  friend Form operator-(const Form& x, const Form& y) { return x + -y; }
  friend Form operator*(const Form& x, const Form& y) {
    if constexpr (curved) return curved_product(x, y);
    Form out;
    double diagonal = 0.0, moduli = 0.0, x_spread = 0.0, y_spread = 0.0;
    for (std::size_t k = 0; k < N; ++k) {
      const double square = x.a[k] * y.a[k];  // of t_k^2, which is 1/2 within 1/2
      diagonal += square;
      moduli += std::abs(square);
      x_spread += std::abs(x.a[k]);
      y_spread += std::abs(y.a[k]);
      out.a[k] = x.c * y.a[k] + y.c * x.a[k];
    }
    out.c = x.c * y.c + 0.5 * diagonal;
    const double x_most = std::abs(x.c) + x_spread, y_most = std::abs(y.c) + y_spread;
    out.r = (x_spread * y_spread - 0.5 * moduli + x_most * y.r + y_most * x.r + x.r * y.r) * (1.0 + forms::grain) +
            2.0 * forms::grain * x_most * y_most + forms::tiny;
    return out;
  }
  friend Form operator*(double k, const Form& x) {
    Form out(k * x.c);
    for (std::size_t i = 0; i < N; ++i) out.a[i] = k * x.a[i];
    for (std::size_t i = 0; i < out.q.size(); ++i) out.q[i] = k * x.q[i];
    out.r = (std::abs(k) * x.r + forms::grain * (std::abs(out.c) + spread(out))) * (1.0 + forms::grain) + forms::tiny;
    return out;
  }

  /// At least the sum of |a_k| and |q_kl|.
  friend double spread(const Form& x) {
    double out = 0.0;
    for (const double slope : x.a) out += std::abs(slope);
    for (const double bend : x.q) out += std::abs(bend);
    return out * (1.0 + forms::grain);
  }
  /// How far values may be from c.
  friend double radius(const Form& x) { return (spread(x) + x.r) * (1.0 + forms::grain); }
  /// Bounds of all values; infinite where nothing is known.
  friend double upper(const Form& x) {
    const double out = detail::above(x.c + radius(x));
    return out == out ? out : std::numeric_limits<double>::infinity();
  }
  friend double lower(const Form& x) { return -upper(-x); }
  friend bool is_known(const Form& x) { return std::isfinite(radius(x)) && std::isfinite(x.c); }

  /// Of x > 0: the second derivative 2/x^3 falls, so that the rest is at most radius^2 / (c^2 least).
  friend Form inverse(const Form& x) {
    const double w = radius(x), least = lower(x);
    if (!(least > 0.0)) return unknown();
    const double value = 1.0 / x.c;
    return linear(x, value, -value * value, 0.0, w * w * value * value / least * (1.0 + forms::grain));
  }
  /// x^(-1/2) of x > 0: the second derivative is 3/4 x^(-5/2).
  friend Form inverse_root(const Form& x) {
    const double w = radius(x), least = lower(x);
    if (!(least > 0.0)) return unknown();
    const double value = 1.0 / std::sqrt(x.c);
    const double part = w / least;  // powers of very small numbers would leave the doubles
    const double rest = 0.375 * part * part / std::sqrt(least) * (1.0 + forms::grain);
    return linear(x, value, -0.5 * value / x.c, 0.0, rest);
  }
  friend Form operator/(const Form& x, const Form& y) { return lower(y) > 0.0 ? x * inverse(y) : unknown(); }
  friend Form square(const Form& x) { return x * x; }
  /// Of x >= 0: |second derivative| is x^(-3/2) / 4. No slope where x may be 0.
  friend Form sqrt(const Form& x) {
    const double w = radius(x), least = lower(x), most = upper(x);
    if (!(least > 0.0))
      return std::isfinite(most) ? of(Interval(0.0, detail::above(std::sqrt(std::max(most, 0.0))))) : unknown();
    const double value = std::sqrt(x.c), part = w / least;
    const double rest = 0.125 * part * part * std::sqrt(least) * (1.0 + forms::grain);
    return linear(x, value, 0.5 / value, -rest, 0.0);
  }
  /// The second derivative of sines is at most 1.
  friend Form sin(const Form& x) {
    const auto at = elementary::sine_cosine(x.c);
    if constexpr (curved) return sine(x, at.sine, at.cosine);
    const double w = radius(x), rest = 0.5 * w * w;
    return linear(x, at.sine, at.cosine, -rest, rest);
  }
  friend Form cos(const Form& x) {
    const auto at = elementary::sine_cosine(x.c);
    if constexpr (curved) return sine(x, at.cosine, -at.sine);
    const double w = radius(x), rest = 0.5 * w * w;
    return linear(x, at.cosine, -at.sine, -rest, rest);
  }
  /// sin(theta) / theta of u = theta^2, the mean of cos(t theta) over t from 0 to 1: |second derivative| <= 1/60.
  friend Form sine_over(const Form& u) { return of_squared_angle(u, 1, 1.0 / 60.0); }
  /// (1 - cos(theta)) / theta^2, the integral of (1 - t) cos(t theta): |second derivative| <= 1/360.
  friend Form one_minus_cosine_over(const Form& u) { return of_squared_angle(u, 2, 1.0 / 360.0); }

 private:
  /// What is left out are products of three and four t_k.
  static Form curved_product(const Form& x, const Form& y) {
    Form out;
    double x_slopes = 0.0, y_slopes = 0.0, x_bends = 0.0, y_bends = 0.0;
    for (std::size_t k = 0; k < N; ++k) {
      x_slopes += std::abs(x.a[k]);
      y_slopes += std::abs(y.a[k]);
      out.a[k] = x.c * y.a[k] + y.c * x.a[k];
    }
    for (std::size_t n = 0; n < out.q.size(); ++n) {
      x_bends += std::abs(x.q[n]);
      y_bends += std::abs(y.q[n]);
      out.q[n] = x.c * y.q[n] + y.c * x.q[n];
    }
    for (std::size_t k = 0, n = 0; k < N; ++k, ++n) {
      for (std::size_t l = 0; l < k; ++l, ++n) out.q[n] += x.a[k] * y.a[l] + x.a[l] * y.a[k];
      out.q[n] += x.a[k] * y.a[k];
    }
    out.c = x.c * y.c;
    const double x_most = std::abs(x.c) + x_slopes + x_bends, y_most = std::abs(y.c) + y_slopes + y_bends;
    out.r = (x_slopes * y_bends + x_bends * (y_slopes + y_bends) + x_most * y.r + y_most * x.r + x.r * y.r) *
                (1.0 + forms::grain) +
            2.0 * forms::grain * x_most * y_most + forms::tiny;
    return out;
  }
  /// A sine with the value and the slope of its middle; the third derivative is at most 1.
  static Form sine(const Form& x, double value, double slope) {
    Form away = x;
    away.c = 0.0;
    const double w = radius(x), rest = w * w * w / 6.0 * (1.0 + forms::grain);
    return linear(x, value, slope, -rest, rest) + (-0.5 * value) * (away * away);
  }
  /// value + slope (x - x.c) + a rest within [low, high].
  static Form linear(const Form& x, double value, double slope, double low, double high) {
    const double half = 0.5 * (high - low);
    Form out(value + 0.5 * (low + high));
    for (std::size_t k = 0; k < N; ++k) out.a[k] = slope * x.a[k];
    for (std::size_t n = 0; n < out.q.size(); ++n) out.q[n] = slope * x.q[n];
    out.r = (std::abs(slope) * x.r + half) * (1.0 + forms::grain) +
            forms::grain * (std::abs(value) + std::abs(slope) * radius(x) + std::abs(low) + std::abs(high)) +
            forms::tiny;
    return out;
  }
  static Form of_squared_angle(const Form& u, int first, double second) {
    const forms::Series at = forms::series(u.c, first);
    const double w = radius(u), rest = 0.5 * second * w * w + 0x1p-46 * (1.0 + w);
    return linear(u, at.value, at.slope, -rest, rest);
  }
};

/// Over a box of poses, whose six coordinates are those of a region.
using PoseForm = Form<6>;
using CurvedForm = Form<6, 2>;

/// Over a box of poses and a box of designs, whose coordinates are the last six.
using DesignForm = Form<12>;

}  // namespace ninedof
