#include "ninedof/robot/tool.hpp"

#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"

namespace ninedof {

Geometry Tool::seen(const Geometry& own) const {
  if (position.isZero(0.0) && !turned()) return own;
  const Mat3 back = axes().transpose();
  const auto moved = [&](const Triple& joints) {
    Triple out;
    for (std::size_t i = 0; i < 3; ++i)
      out[i] = turned() ? Vec3(back * (joints[i] - position)) : Vec3(joints[i] - position);
    return out;
  };
  return {own.base_external(), own.base_internal(), moved(own.platform_external()), moved(own.platform_internal())};
}

void Tool::validate() const {
  require_coordinates("tool.position", position);
  for (const double x : rotation) require_finite("tool.rotation", x);
}

}  // namespace ninedof
