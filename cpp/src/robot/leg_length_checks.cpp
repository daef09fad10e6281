#include "robot/leg_length_checks.hpp"

#include <cmath>

#include "ninedof/math/error.hpp"

namespace ninedof {

void require_leg_lengths(const Vec9& lengths) {
  for (const double length : lengths)
    if (!(length >= 0.0) || !std::isfinite(length))
      throw InvalidArgument("leg_lengths", format_number(length), "nine finite lengths >= 0");
  if (lengths.isZero(0.0)) throw InvalidArgument("leg_lengths", "nine zeros", "at least one positive length");
}

}  // namespace ninedof
