#pragma once
/// Low-discrepancy points of the unit cube.

#include <cmath>
#include <cstdint>

#include "math/splitmix.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

/// Kronecker sequence of the root of x^4 = x + 1 (Roberts' R_3): point n is frac(shift + n (1/x, 1/x^2, 1/x^3)).
inline Vec3 sequence_point(long n, const Vec3& shift) {
  constexpr double root = 1.2207440846057596;
  const Vec3 step(1.0 / root, 1.0 / (root * root), 1.0 / (root * root * root));
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    const double x = shift[k] + static_cast<double>(n + 1) * step[k];
    out[k] = x - std::floor(x);
  }
  return out;
}

/// The shift number `which` of a seed.
inline Vec3 sequence_shift(std::uint64_t seed, std::uint64_t which) {
  const std::uint64_t z = stream(seed, which);
  return {uniform_from(z), uniform_from(z + 0x9E3779B97F4A7C15ULL), uniform_from(z + 2 * 0x9E3779B97F4A7C15ULL)};
}

}  // namespace ninedof
