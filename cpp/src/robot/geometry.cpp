#include "ninedof/robot/geometry.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "ninedof/math/rotation.hpp"
#include "ninedof/robot/hexagon.hpp"
#include "robot/triangle.hpp"

namespace ninedof {
namespace {

constexpr double tolerance = 1e-9;  // relative: below it joints are on one line, and legs coincide
constexpr auto to_tolerance = ", to 1e-9 of the size";

/// The longest side. Throws unless it is a length; `lost` is what three joints in one point do.
double longest_side(const std::string& name, const Triple& t, const std::string& lost) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!t[i].allFinite())
      throw InvalidArgument(name, "a non-finite coordinate in joint " + std::to_string(i + 1), "three finite points");
  for (const Vec3& joint : t) require_coordinates(name.c_str(), joint);
  const double longest = std::max({(t[1] - t[0]).norm(), (t[2] - t[0]).norm(), (t[2] - t[1]).norm()});
  if (longest == 0.0) throw InvalidArgument(name, "three coincident joints: " + lost, "joints apart from each other");
  if (longest < least_length)
    throw InvalidArgument(name, "a triangle of size " + format_number(longest),
                          "one of at least " + format_number(least_length));
  return longest;
}

void require_triangle(const std::string& name, const Triple& t, const std::string& lost) {
  const double longest = longest_side(name, t, lost);
  const double height = relative_height(t, longest);
  if (!(height > tolerance))
    throw InvalidArgument(
        name, "collinear joints (height / longest side = " + format_number(height) + "): " + lost + to_tolerance,
        "joints that span a triangle");
}

void require_legs_apart(const Triple& base, const Triple& platform) {
  const std::string lost = "det N is 0 at every pose";
  const double one = longest_side("base_external", base, lost),
               other = longest_side("platform_external", platform, lost);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < i; ++k)
      if ((base[i] - base[k]).norm() <= tolerance * one && (platform[i] - platform[k]).norm() <= tolerance * other)
        throw InvalidArgument("base_external, platform_external",
                              "external legs " + std::to_string(k + 1) + " and " + std::to_string(i + 1) +
                                  " with the same joints: " + lost + to_tolerance,
                              "legs that differ in at least one joint");
}

void require_side(const std::string& name, double side) {
  if (!std::isfinite(side) || side < 0.0) throw InvalidArgument(name, format_number(side), "a finite length >= 0");
  require_coordinate(name.c_str(), side);
}

/// Joints 2 and 3 from joint 1: eqs. (37)-(38) number the joints clockwise.
Triple orbit_of(const Vec3& first) {
  const double angle = 2.0 * std::numbers::pi / 3.0;
  return {first, rotation_about_z(-angle) * first, rotation_about_z(-2.0 * angle) * first};
}

/// The two interleaved triples of a semi-regular hexagon with sides s1, s2.
struct Hexagon {
  Triple external, internal;
};
Hexagon hexagon(double s1, double s2) {
  const Xyz<double> one = hexagon_joint_1(s1, s2), two = hexagon_joint_2(s1, s2), three = hexagon_joint_3(s1, s2);
  return {{vec3(one), vec3(two), vec3(three)}, {vec3(mirrored(one)), vec3(mirrored(three)), vec3(mirrored(two))}};
}

Triple orbit_of(const std::string& name, const Orbit& o) {
  require_positive((name + ".radius").c_str(), o.radius);
  require_finite((name + ".angle").c_str(), o.angle);
  require_finite((name + ".height").c_str(), o.height);
  return orbit_of(Vec3(o.radius * std::cos(o.angle), o.radius * std::sin(o.angle), o.height));
}

}  // namespace

Geometry::Geometry(const Triple& base_external, const Triple& base_internal, const Triple& platform_external,
                   const Triple& platform_internal)
    : base_external_(base_external),
      base_internal_(base_internal),
      platform_external_(platform_external),
      platform_internal_(platform_internal) {
  require_legs_apart(base_external_, platform_external_);
  require_triangle("base_internal", base_internal_, "det B is 0 at every pose");
  require_triangle("platform_internal", platform_internal_, "det C is 0 at every pose");
}

Geometry Geometry::hexagonal(double a1, double a2, double b1, double b2) {
  require_side("a1", a1);
  require_side("a2", a2);
  require_side("b1", b1);
  require_side("b2", b2);
  if (a1 == 0.0 && a2 == 0.0) throw InvalidArgument("a1, a2", "0 and 0", "a base of some size: at least one side > 0");
  if (b1 == 0.0 && b2 == 0.0)
    throw InvalidArgument("b1, b2", "0 and 0", "a platform of some size: at least one side > 0");
  const Hexagon base = hexagon(a1, a2), platform = hexagon(b1, b2);
  return {base.external, base.internal, platform.external, platform.internal};
}

Geometry Geometry::symmetric(const Orbit& base_external, const Orbit& base_internal, const Orbit& platform_external,
                             const Orbit& platform_internal) {
  return {orbit_of("base_external", base_external), orbit_of("base_internal", base_internal),
          orbit_of("platform_external", platform_external), orbit_of("platform_internal", platform_internal)};
}

}  // namespace ninedof
