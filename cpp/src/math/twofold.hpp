#pragma once
/// Numbers of twice the precision: unevaluated sums of two doubles (T. J. Dekker, Numerische Mathematik 18, 1971).

#include <cmath>

namespace ninedof {

struct Twofold {
  double high, low;

  Twofold(double x = 0.0) : Twofold(x, 0.0) {}  // NOLINT(google-explicit-constructor)
  Twofold(double h, double l) : high(h), low(l) {}

  /// a + b without rounding.
  static Twofold sum(double a, double b) {
    const double s = a + b, part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }
  /// a b without rounding.
  static Twofold product(double a, double b) {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
  }
  /// a + b for |a| >= |b|.
  static Twofold normalized(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }
};

inline Twofold operator+(const Twofold& a, const Twofold& b) {
  const Twofold s = Twofold::sum(a.high, b.high);
  return Twofold::normalized(s.high, s.low + (a.low + b.low));
}
inline Twofold operator-(const Twofold& a) {
  return {-a.high, -a.low};
}
inline Twofold operator-(const Twofold& a, const Twofold& b) {
  return a + -b;
}
inline Twofold operator*(const Twofold& a, const Twofold& b) {
  const Twofold p = Twofold::product(a.high, b.high);
  return Twofold::normalized(p.high, p.low + (a.high * b.low + a.low * b.high));
}
/// One step of Newton's method from the inverse in doubles.
inline Twofold inverse(const Twofold& a) {
  const Twofold start = 1.0 / a.high;
  return start + start * (1.0 - a * start);
}

}  // namespace ninedof
