#pragma once
/// The designs that the study of a certificate allows, in the reduced coordinates.

#include <array>

#include "proof/checker/certificate_file.hpp"

namespace ninedof::checker {

/// Coordinates: U / l_c, x = R/U, eta = zp/U, o = zs/(zp - zs), tan(theta/2), y, z; or, where radii of internal joints
/// begin at 0, 1 + t, y/t and z/(1 - t) in the places of o, y and z.
constexpr std::size_t coordinates = 7;
using Box = std::array<Range, coordinates>;

/// What U / l_c is: a coordinate, or what the others make of it.
enum class Length { free, mean_leg, platform_radius, natural };

struct Domain : RatioLimits {
  int dimension = 5;
  bool slopes = false;
  Length length = Length::free;
  Range scale{1.0};  ///< l_c, in the unit of the lengths
  Box box;
  Range R, R_internal, U, U_internal, zp, zs;
  double target = 0.0;
};

Domain domain_of(const Certificate& c);

/// zs / zp.
Range share(const Domain& d, const Box& b);

bool empty(const Box& box);

/// Whether no design of the box keeps the bounds.
bool outside(const Domain& d, const Box& b);

/// The part of a box outside of which no design keeps the bounds; empty if none does. Boxes that touch the bounds at a
/// corner, up to rounding, shrink to that corner.
Box narrowed(const Domain& d, Box b);

}  // namespace ninedof::checker
