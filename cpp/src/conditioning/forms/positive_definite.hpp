#pragma once
/// Symmetric matrices that are proved to be positive definite.

#include "conditioning/forms/gram.hpp"

namespace ninedof::forms {

constexpr std::size_t packed(std::size_t n) {
  return n * (n + 1) / 2;
}

/// Whether the symmetric matrix is positive definite, proved: its Cholesky decomposition runs to the end although more
/// than its rounding errors was taken from the diagonal (Rump, BIT 2006). `room`: what is taken, entry by entry.
template <std::size_t N>
bool positive_definite(const std::array<double, packed(N)>& a, const std::array<double, N>& room) {
  std::array<double, packed(N)> l;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[entry(i, j)];
      if (i == j) sum -= room[i];
      for (std::size_t k = 0; k < j; ++k) sum -= l[entry(i, k)] * l[entry(j, k)];
      if (i > j) l[entry(i, j)] = sum * l[entry(j, j)];
      else if (!(sum > 0.0)) return false;
      else l[entry(i, i)] = 1.0 / std::sqrt(sum);
    }
  return true;
}

}  // namespace ninedof::forms
