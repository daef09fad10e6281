#pragma once
/// A stop inside a loop over very many short items.

#include "ninedof/math/control.hpp"

namespace ninedof {

/// Throws Stopped on a stop; looks at one item of many only.
inline void stop_at_times(long item, const std::stop_token& stop) {
  if (item % 4096 == 0 && stop.stop_requested()) throw Stopped{};
}

}  // namespace ninedof
