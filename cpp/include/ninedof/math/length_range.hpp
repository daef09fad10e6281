#pragma once
/// The range of lengths, in any unit: within it no result overflows or loses digits to underflow, and twice as many
/// metres as the visible universe has are far inside. Checked where a geometry, a configuration, leg lengths or a
/// characteristic length come in (docs/conventions.md).

#include "ninedof/math/types.hpp"

namespace ninedof {

constexpr double least_length = 1e-100, most_length = 1e100;

/// Throws InvalidArgument unless `length` is within the range.
void require_length(const char* argument, double length);

/// Throws InvalidArgument unless `coordinate` is finite and at most most_length in size; it may be zero.
void require_coordinate(const char* argument, double coordinate);
void require_coordinates(const char* argument, const Vec3& point);

}  // namespace ninedof
