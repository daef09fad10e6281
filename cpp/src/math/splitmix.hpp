#pragma once
/// Repeatable random numbers without the state of a generator.

#include <cstdint>

namespace ninedof {

/// The last mixing step of splitmix64.
inline std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

/// A number uniform in [0, 1) from any 64 bits.
inline double uniform_from(std::uint64_t z) {
  return static_cast<double>(mixed(z) >> 11) * 0x1.0p-53;
}

/// Where the numbers of stream `which` of a seed begin.
inline std::uint64_t stream(std::uint64_t seed, std::uint64_t which) {
  return (seed + 1) * 0x9E3779B97F4A7C15ULL + which * 0xD1B54A32D192ED03ULL;
}

}  // namespace ninedof
