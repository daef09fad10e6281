#pragma once
/// The configuration with given leg lengths that is reached from a known one nearby.

#include <optional>

#include "ninedof/configuration.hpp"
#include "ninedof/geometry.hpp"
#include "ninedof/types.hpp"

namespace ninedof {

/// Newton's method on the nine lengths. Its steps must at least halve from the first on, which keeps the answer within
/// two first steps of the start. Where they do not, the way there is cut in halves, down to 1/64 of it. None if that
/// fails: at a singular configuration, or where the lengths change too much to be followed.
std::optional<Configuration> solve_near(const Geometry& g, const Vec9& lengths, const Configuration& start);

}  // namespace ninedof
