#pragma once
/// Rounding, infinity and NaN of double, and what counts as zero.

#include <limits>

namespace ninedof {

inline constexpr double eps = std::numeric_limits<double>::epsilon();  ///< 2^-52: twice the unit roundoff
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A singular value below this fraction of the largest is rounding error: in double precision the configuration cannot
/// be distinguished from a singular one, and counts as singular.
inline constexpr double negligible = 16.0 * eps;

}  // namespace ninedof
