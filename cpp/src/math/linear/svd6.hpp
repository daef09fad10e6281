#pragma once
/// Singular values of a 6x6 matrix by one-sided Jacobi rotations.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Singular values, descending. No allocation. All NaN if the input has NaN, all infinite if it has an infinite entry.
/// Each is accurate to a few rounding errors of the largest, small ones often to far less.
Vec6 singular_values_6x6(const Mat6& m);

/// Singular values, descending, and the right singular vectors in the same order, one a column.
struct RightSvd {
  Vec6 sigma;
  Mat6 v;
};
RightSvd right_svd_6x6(const Mat6& m);

}  // namespace ninedof
