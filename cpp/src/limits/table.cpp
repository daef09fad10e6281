#include "limits/table.hpp"

#include "limits/rows.hpp"

namespace ninedof {

// Alone in its object file: a program that defines the table itself, as a test does, links its own.
std::span<const LimitRow> limit_rows() {
  return known_limits;
}

}  // namespace ninedof
