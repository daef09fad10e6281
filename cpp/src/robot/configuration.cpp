#include "ninedof/robot/configuration.hpp"

#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "ninedof/math/rotation.hpp"

namespace ninedof {

Configuration neutral(double zp, double zs, double theta_z) {
  require_coordinate("zp", zp);
  require_coordinate("zs", zs);
  require_finite("theta_z", theta_z);
  return {Vec3(0.0, 0.0, zp), rotation_about_z(theta_z), Vec3(0.0, 0.0, zs)};
}

Configuration plus(const Configuration& c, const Vec9& tangent) {
  return {c.position + tangent.segment<3>(3), exp_rotation(tangent.head<3>()) * c.rotation,
          c.internal_point + tangent.tail<3>()};
}

Vec9 minus(const Configuration& to, const Configuration& from) {
  Vec9 tangent;
  tangent << log_rotation(to.rotation * from.rotation.transpose()), to.position - from.position,
      to.internal_point - from.internal_point;
  return tangent;
}

void validate(const Configuration& c) {
  if (!c.position.allFinite()) throw InvalidArgument("position", "a non-finite coordinate", "three finite numbers");
  if (!c.internal_point.allFinite())
    throw InvalidArgument("internal_point", "a non-finite coordinate", "three finite numbers");
  require_coordinates("position", c.position);
  require_coordinates("internal_point", c.internal_point);
  require_rotation("rotation", c.rotation);
}

}  // namespace ninedof
