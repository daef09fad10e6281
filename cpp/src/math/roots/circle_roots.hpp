#pragma once
/// Real roots of a polynomial of degree eight on the whole projective line, that is, of a trigonometric polynomial of degree four
/// on the circle.

#include <array>

namespace ninedof {

/// Coefficients of 1, x, ..., x^8. The leading ones may be small or zero: x = infinity is a point like any other.
using Octic = std::array<double, 9>;

/// A root as the direction (x, y) with x / y the root, max(|x|, |y|) = 1.
struct CirclePoint {
  double x, y;
};

/// The roots found, each to about `root_accuracy`; a solver is expected to polish them.
struct CircleRoots {
  std::array<CirclePoint, 8> root;
  int count = 0;
  bool certain = true;  ///< false where two roots could not be told apart or from none: the count is no answer then
};

constexpr double root_accuracy = 1e-5;

/// Descartes' rule of signs in Bernstein form: an interval whose coefficients change sign once holds one root, where they do not
/// there is none, all others are halved. Coefficients are known to about `error`, or to rounding of the largest if that is more.
CircleRoots circle_roots(const Octic& p, double error);

}  // namespace ninedof
