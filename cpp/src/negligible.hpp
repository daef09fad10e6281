#pragma once
/// Where rounding begins.

#include <limits>

namespace ninedof {

/// Below this fraction of the largest, a singular value is rounding: double precision cannot tell the configuration
/// from a singular one, and it is called singular.
constexpr double negligible = 16.0 * std::numeric_limits<double>::epsilon();

}  // namespace ninedof
