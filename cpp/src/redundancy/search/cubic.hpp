#pragma once
/// The first zero of a cubic polynomial.

#include <array>

namespace ninedof {

/// The first t in (0, most] where c0 + c1 t + c2 t^2 + c3 t^3 changes sign or touches zero; `most` where there is none.
/// c0 must not be zero.
double first_zero(const std::array<double, 4>& c, double most);

}  // namespace ninedof
