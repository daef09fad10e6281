#pragma once
/// The threshold below which a singular value counts as zero.

#include "math/numbers.hpp"

namespace ninedof {

/// As a fraction of the largest singular value. Below it a singular value is rounding error: in double precision the
/// configuration cannot be distinguished from a singular one, and counts as singular.
constexpr double negligible = 16.0 * eps;

}  // namespace ninedof
