#pragma once
/// 3x3 systems by Cramer's rule, written once over the number type: double for one system, Lanes for two side by side.
///
/// Inlined by force: the compiler takes these few instructions for many, and forward velocity would cost half as much again.

#include <Eigen/Core>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

/// Two numbers worked on at once: one instruction wherever there are 128-bit vectors.
using Lanes = Eigen::Array2d;

/// A vector over a number type.
template <class T>
struct Xyz {
  T x, y, z;
};

EIGEN_ALWAYS_INLINE Xyz<double> xyz(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
EIGEN_ALWAYS_INLINE Vec3 vec3(const Xyz<double>& v) {
  return {v.x, v.y, v.z};
}
EIGEN_ALWAYS_INLINE Xyz<double> lane(const Xyz<Lanes>& v, Eigen::Index k) {
  return {v.x[k], v.y[k], v.z[k]};
}

template <class T>
EIGEN_ALWAYS_INLINE Xyz<T> operator+(const Xyz<T>& a, const Xyz<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
EIGEN_ALWAYS_INLINE Xyz<T> operator-(const Xyz<T>& a, const Xyz<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
EIGEN_ALWAYS_INLINE Xyz<T> operator*(const T& k, const Xyz<T>& v) {
  return {k * v.x, k * v.y, k * v.z};
}
template <class T>
EIGEN_ALWAYS_INLINE T dot(const Xyz<T>& a, const Xyz<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
EIGEN_ALWAYS_INLINE Xyz<T> cross(const Xyz<T>& a, const Xyz<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// NaN for a determinant that is zero, underflows, overflows or is none: nothing divided by it would be true.
EIGEN_ALWAYS_INLINE double reciprocal_or_nan(double determinant) {
  return std::isnormal(determinant) ? 1.0 / determinant : not_a_number;
}
EIGEN_ALWAYS_INLINE Lanes reciprocal_or_nan(const Lanes& determinant) {
  return {reciprocal_or_nan(determinant[0]), reciprocal_or_nan(determinant[1])};
}

/// The system with rows a, b, c. The rule commutes with a scaling of rows, so they need not be normalised for accuracy.
template <class T>
class Cramer {
 public:
  EIGEN_ALWAYS_INLINE Cramer(const Xyz<T>& a, const Xyz<T>& b, const Xyz<T>& c)
      : adjugate_{cross(b, c), cross(c, a), cross(a, b)},
        reciprocal_determinant_(reciprocal_or_nan(dot(a, adjugate_[0]))) {}

  /// NaN throughout where the rows are exactly dependent.
  EIGEN_ALWAYS_INLINE Xyz<T> solve(const T& a, const T& b, const T& c) const {
    return T(a * reciprocal_determinant_) * adjugate_[0] + T(b * reciprocal_determinant_) * adjugate_[1] +
           T(c * reciprocal_determinant_) * adjugate_[2];
  }

  /// Column k of the inverse times `factor`: the solution for a right side that is zero but for its entry k.
  EIGEN_ALWAYS_INLINE Xyz<T> column(std::size_t k, const T& factor) const {
    return T(factor * reciprocal_determinant_) * adjugate_[k];
  }

 private:
  Xyz<T> adjugate_[3];
  T reciprocal_determinant_;
};

}  // namespace ninedof
