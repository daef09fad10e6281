#pragma once

namespace ninedof {

/// A leg shorter than this part of the longest one, squared, is a difference of which rounding has eaten digits: five,
/// and as many more as the coordinates of its ends are larger than the legs.
inline constexpr double short_leg = 1e-10;

}  // namespace ninedof
