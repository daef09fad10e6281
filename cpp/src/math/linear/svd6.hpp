#pragma once
/// Singular values of a 6x6 matrix by one-sided Jacobi rotations.

#include "math/linear/jacobi_svd.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

/// Singular values, descending. No allocation. All NaN if the input has NaN, all infinite if it has an infinite entry.
/// Each is accurate to a few rounding errors of the largest, small ones often to far less.
Vec6 singular_values_6x6(const Mat6& m);

/// With the right singular vectors.
RightSvd<6> right_svd_6x6(const Mat6& m);

}  // namespace ninedof
