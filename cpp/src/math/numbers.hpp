#pragma once
/// Rounding, infinity and NaN of double.

#include <limits>

namespace ninedof {

inline constexpr double eps = std::numeric_limits<double>::epsilon();  ///< 2^-52: twice the unit roundoff
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace ninedof
