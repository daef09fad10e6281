#pragma once
/// The check of leg lengths given by a user.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Throws InvalidArgument unless all are finite, none is negative and at least one is positive.
void require_leg_lengths(const Vec9& lengths);

}  // namespace ninedof
