#pragma once
/// A function of O to second order: value, gradient and Hessian at one point.

#include "ninedof/math/types.hpp"

namespace ninedof {

struct Jet {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();

  /// Adds `weight` times another.
  void add(double weight, const Jet& other) {
    value += weight * other.value;
    gradient += weight * other.gradient;
    hessian += weight * other.hessian;
  }
  /// Adds f(other), given f and its first two derivatives there.
  void add_function(double f, double slope, double curvature, const Jet& other) {
    value += f;
    gradient += slope * other.gradient;
    hessian += slope * other.hessian + curvature * (other.gradient * other.gradient.transpose());
  }
};

}  // namespace ninedof
