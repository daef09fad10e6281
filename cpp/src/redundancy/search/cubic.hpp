#pragma once
/// Where a polynomial of third degree first vanishes.

#include <array>

namespace ninedof {

/// The first zero of c0 + c1 t + c2 t^2 + c3 t^3 in (0, most], `most` where there is none. It changes sign or touches zero there; c0
/// is not zero.
double first_zero(const std::array<double, 4>& c, double most);

}  // namespace ninedof
