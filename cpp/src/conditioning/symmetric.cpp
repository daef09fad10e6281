/// Symmetry checks. The closed form itself is a template in ninedof/conditioning/symmetric.hpp.

#include "ninedof/conditioning/symmetric.hpp"

#include <algorithm>
#include <numbers>
#include <string>

#include "ninedof/math/error.hpp"
#include "ninedof/math/rotation.hpp"

namespace ninedof {
namespace {

constexpr double tolerance = 1e-9;

void require_orbit(const std::string& name, const Triple& t) {
  const double angle = -2.0 * std::numbers::pi / 3.0;
  const double size = std::max({t[0].norm(), t[1].norm(), t[2].norm()});
  const double miss =
      std::max((rotation_about_z(angle) * t[0] - t[1]).norm(), (rotation_about_z(angle) * t[1] - t[2]).norm());
  if (!(miss <= tolerance * size))
    throw InvalidArgument(name, "joints off a C3 orbit by " + format_number(miss),
                          "three joints that rotations by -120 degrees about z carry into each other");
}

void require_on_axis(const std::string& name, const Vec3& point, double size) {
  const double offset = point.head<2>().norm();
  if (!(offset <= tolerance * size))
    throw InvalidArgument(name, "a point " + format_number(offset) + " off the z axis", "a point on the symmetry axis");
}

}  // namespace

AxisDesign<double> axis_design(const Geometry& g, const Configuration& c) {
  validate(c);
  require_orbit("base_external", g.base_external());
  require_orbit("base_internal", g.base_internal());
  require_orbit("platform_external", g.platform_external());
  require_orbit("platform_internal", g.platform_internal());
  const double size = std::max(g.base_internal()[0].norm(), g.platform_internal()[0].norm());
  require_on_axis("position", c.position, size);
  require_on_axis("internal_point", c.internal_point, size);
  if (!((c.rotation.col(2) - Vec3::UnitZ()).norm() <= tolerance))
    throw InvalidArgument("rotation", "a tilted platform", "a rotation about z");
  return {xyz(g.base_external()[0]),
          xyz(g.base_internal()[0]),
          xyz(c.rotation * g.platform_external()[0]),
          xyz(c.rotation * g.platform_internal()[0]),
          c.position.z(),
          c.internal_point.z()};
}

}  // namespace ninedof
