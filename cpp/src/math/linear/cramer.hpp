#pragma once
/// 3x3 systems by Cramer's rule over the number type: double for one system, Lanes for two side by side.
///
/// Always inlined: the compiler overestimates its size, and forward velocity would take half as long again.

#include <Eigen/Core>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/types.hpp"
#include "ninedof/math/xyz.hpp"

namespace ninedof {

/// Two numbers in one 128-bit vector.
using Lanes = Eigen::Array2d;

EIGEN_ALWAYS_INLINE Xyz<double> lane(const Xyz<Lanes>& v, Eigen::Index k) {
  return {v.x[k], v.y[k], v.z[k]};
}

/// NaN for a determinant that is zero, subnormal, infinite or NaN: no quotient by it would be accurate.
EIGEN_ALWAYS_INLINE double reciprocal_or_nan(double determinant) {
  return std::isnormal(determinant) ? 1.0 / determinant : not_a_number;
}
EIGEN_ALWAYS_INLINE Lanes reciprocal_or_nan(const Lanes& determinant) {
  return {reciprocal_or_nan(determinant[0]), reciprocal_or_nan(determinant[1])};
}

/// The system with rows a, b, c. Scaling a row does not change the accuracy, so rows need not be unit vectors.
template <class T>
class Cramer {
 public:
  EIGEN_ALWAYS_INLINE Cramer(const Xyz<T>& a, const Xyz<T>& b, const Xyz<T>& c)
      : adjugate_{cross(b, c), cross(c, a), cross(a, b)},
        reciprocal_determinant_(reciprocal_or_nan(dot(a, adjugate_[0]))) {}

  /// All NaN where the rows are exactly dependent.
  EIGEN_ALWAYS_INLINE Xyz<T> solve(const T& a, const T& b, const T& c) const {
    return T(a * reciprocal_determinant_) * adjugate_[0] + T(b * reciprocal_determinant_) * adjugate_[1] +
           T(c * reciprocal_determinant_) * adjugate_[2];
  }

  /// Column k of the inverse times `factor`: the solution for a right side with the one entry k.
  EIGEN_ALWAYS_INLINE Xyz<T> column(std::size_t k, const T& factor) const {
    return T(factor * reciprocal_determinant_) * adjugate_[k];
  }

 private:
  Xyz<T> adjugate_[3];
  T reciprocal_determinant_;
};

}  // namespace ninedof
