#pragma once
/// A unit of length, a power of two, in which no product of lengths overflows. Such a factor changes no digits.

#include <optional>

#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

double largest_coordinate(const Geometry& g);

/// The exponent of the unit for lengths up to `largest`: 0 for all but extreme ones.
int unit_exponent(double largest);

/// The joints times 2^exponent; none if a plate is lost by underflow.
std::optional<Geometry> scaled(const Geometry& g, int exponent);

Vec9 scaled(const Vec9& lengths, int exponent);
Configuration scaled(const Configuration& c, int exponent);

}  // namespace ninedof
