#pragma once
/// A function of time with proved bounds: its Taylor coefficients at t, their rounding errors, and bounds on them over
/// a window [t, t + h]. Sums and products propagate all three: a formula is written once and yields its own proof.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "math/elementary.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

/// T is double or a vector; the size of a vector is its norm.
template <class T>
struct Enclosure {
  std::array<T, 3> at;             ///< f(t), f'(t), f''(t) / 2
  std::array<double, 3> error;     ///< largest absolute error of each
  std::array<double, 4> bound;     ///< of |f|, |f'|, |f''| / 2, |f'''| / 6 over the window
};

namespace detail {

inline double size(double x) {
  return std::abs(x);
}
inline double size(const Vec3& x) {
  return x.norm();
}

/// Relative rounding error of a coefficient of a product: few products of few terms.
constexpr double product_error = 16.0 * eps;

/// A coefficient is also bounded by its value at t and what the next one adds over the window.
template <class T>
void tighten(Enclosure<T>& x, double window) {
  for (std::size_t k = 3; k-- > 0;)
    x.bound[k] =
        std::min(x.bound[k], size(x.at[k]) + x.error[k] + static_cast<double>(k + 1) * window * x.bound[k + 1]);
}

/// Any product with |a b| <= |a| |b|.
template <class A, class B, class Product>
auto multiply(const Enclosure<A>& a, const Enclosure<B>& b, double window, const Product& product) {
  using T = std::decay_t<decltype(product(a.at[0], b.at[0]))>;
  Enclosure<T> out;
  std::array<double, 3> size_a, size_b;
  for (std::size_t k = 0; k < 3; ++k) {
    size_a[k] = size(a.at[k]);
    size_b[k] = size(b.at[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    out.at[k] = product(a.at[0], b.at[k]);
    for (std::size_t i = 1; i <= k; ++i) out.at[k] += product(a.at[i], b.at[k - i]);
    out.error[k] = 0.0;
    for (std::size_t i = 0; i <= k; ++i) {
      const double ea = a.error[i], eb = b.error[k - i], sa = size_a[i], sb = size_b[k - i];
      out.error[k] += sa * eb + ea * sb + ea * eb + product_error * sa * sb;
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    out.bound[k] = 0.0;
    for (std::size_t i = 0; i <= k; ++i) out.bound[k] += a.bound[i] * b.bound[k - i];
  }
  tighten(out, window);
  return out;
}

}  // namespace detail

inline Enclosure<Vec3> cross(const Enclosure<Vec3>& a, const Enclosure<Vec3>& b, double window) {
  return detail::multiply(a, b, window, [](const Vec3& x, const Vec3& y) -> Vec3 { return x.cross(y); });
}

inline Enclosure<double> dot(const Enclosure<Vec3>& a, const Enclosure<Vec3>& b, double window) {
  return detail::multiply(a, b, window, [](const Vec3& x, const Vec3& y) { return x.dot(y); });
}

/// The rounding error of the sum itself is at most eps times the sizes of the terms.
template <class T>
Enclosure<T> operator+(const Enclosure<T>& a, const Enclosure<T>& b) {
  Enclosure<T> out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.at[k] = a.at[k] + b.at[k];
    out.error[k] = a.error[k] + b.error[k] + eps * (detail::size(a.at[k]) + detail::size(b.at[k]));
  }
  for (std::size_t k = 0; k < 4; ++k) out.bound[k] = a.bound[k] + b.bound[k];
  return out;
}

/// start + t velocity. `size` is that of the coordinates that `start` is a sum of, `error` its error beyond rounding.
struct Line {
  Vec3 start, velocity;
  double size, error = 0.0;

  Enclosure<Vec3> at(double t, double window) const {
    const double speed = velocity.norm();
    Enclosure<Vec3> out{{start + t * velocity, velocity, Vec3::Zero()},
                        {4.0 * eps * (size + t * speed) + error, 2.0 * eps * speed, 0.0},
                        {infinity, speed, 0.0, 0.0}};
    detail::tighten(out, window);
    return out;
  }
};

/// exp(t omega) v by Rodrigues' formula; v is a vector of the platform in base axes, `v_error` beyond rounding.
struct Turning {
  Turning(const Vec3& v, const Vec3& omega, double v_error = 0.0) : rate(omega.norm()), size(v.norm()), error(v_error) {
    const Vec3 axis = rate > 0.0 ? Vec3(omega / rate) : Vec3(Vec3::Zero());
    along = axis.dot(v) * axis;
    across = v - along;
    around = axis.cross(v);
  }

  Enclosure<Vec3> at(double t, double window) const {
    const double angle = rate * t;
    const bool far = !(angle < elementary::most_radians);  // where nothing is known of the direction
    const auto [s, c] = far ? elementary::SineCosine{0.0, 0.0} : elementary::sine_cosine(angle);
    const Vec3 part = c * across + s * around;
    const double off = (far ? 2.0 : 8.0 * eps * (1.0 + angle)) * size + error,
                 radius = around.norm() + 4.0 * eps * size;
    Enclosure<Vec3> out{{along + part, rate * (c * around - s * across), -0.5 * rate * rate * part},
                        {off, rate * off, rate * rate * off},
                        {infinity, rate * radius, 0.5 * rate * rate * radius, rate * rate * rate * radius / 6.0}};
    detail::tighten(out, window);
    return out;
  }

  double rate, size, error;
  Vec3 along, across, around;
};

}  // namespace ninedof
