#pragma once
/// Corners of the box of errors that the nine legs may have.

#include <algorithm>
#include <bit>
#include <cmath>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// What three rows make of the nine errors of legs.
using Columns9 = Eigen::Matrix<double, 3, 9>;

/// Whether `holds(signs, columns * signs)` at every corner of [-1, 1]^9: at 256, one of two opposite corners. From
/// one to the next a single sign changes (Gray code): the sum is within 2^-42 of that of all moduli.
template <class Holds>
bool at_all_corners(const Columns9& columns, const Holds& holds) {
  Vec9 signs = Vec9::Ones();
  Vec3 sum = columns.rowwise().sum();
  for (unsigned n = 1; holds(signs, sum); ++n) {
    if (n == 256) return true;
    const int k = std::countr_zero(n);
    signs[k] = -signs[k];
    sum += 2.0 * signs[k] * columns.col(k);
  }
  return false;
}

/// The greatest length of columns * d over the corners d.
inline double farthest_corner(const Columns9& columns) {
  double largest = 0.0;
  at_all_corners(columns, [&](const Vec9&, const Vec3& sum) {
    largest = std::max(largest, sum.squaredNorm());
    return true;
  });
  return std::sqrt(largest);
}

}  // namespace ninedof
