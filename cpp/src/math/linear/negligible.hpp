#pragma once
/// Where rounding begins.

#include "math/numbers.hpp"

namespace ninedof {

/// Below this fraction of the largest, a singular value is rounding: double precision cannot tell the configuration
/// from a singular one, and it is called singular.
constexpr double negligible = 16.0 * eps;

}  // namespace ninedof
