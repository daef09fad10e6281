#pragma once
/// Real roots of an octic on the projective line, that is, of a trigonometric polynomial of degree four on the circle.

#include <array>

namespace ninedof {

/// Coefficients of 1, x, ..., x^8. The leading ones may be small or zero: x = infinity is an ordinary point.
using Octic = std::array<double, 9>;

/// A root as the direction (x, y) with x / y the root, max(|x|, |y|) = 1.
struct CirclePoint {
  double x, y;
};

/// The roots found, each to about `root_accuracy`; the caller polishes them.
struct CircleRoots {
  std::array<CirclePoint, 8> root;
  int count = 0;
  bool certain = true;  ///< false where two roots could not be separated or may not exist: then the count is uncertain
};

constexpr double root_accuracy = 1e-5;

/// Descartes' rule of signs in Bernstein form: an interval whose coefficients change sign once contains one root,
/// without a sign change it contains none, all others are halved. `error` is the absolute error of the coefficients;
/// rounding errors of the largest coefficient are assumed if they are greater.
CircleRoots circle_roots(const Octic& p, double error);

}  // namespace ninedof
