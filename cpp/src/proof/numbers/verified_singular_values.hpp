#pragma once
/// Singular values with certainty, from approximate singular vectors (docs/theory/proof.md, lemma 5).

#include <array>

#include "ninedof/math/interval.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

/// Bounds of the singular values, descending, of every matrix within `radius` of `m` in the spectral norm. From 0 to
/// infinity where the vectors found are no use.
std::array<Interval, 6> verified_singular_values(const Mat6& m, double radius);

/// A number at or below the least singular value of every 6x3 matrix within `radius` of `m`; 0 where none is found.
double least_singular_value(const Eigen::Matrix<double, 6, 3>& m, double radius);

}  // namespace ninedof
