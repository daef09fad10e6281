#pragma once
/// What leg lengths must be before anything is made of them.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Throws InvalidArgument unless all are finite, none is negative and one is positive.
void require_leg_lengths(const Vec9& lengths);

}  // namespace ninedof
