#pragma once
/// Machines within tolerances.

#include "ninedof/math/error.hpp"
#include "ninedof/proof/machine.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof::over_region {

/// How far the joints of a leg may be from those of the drawing, of both ends together and with what is given.
inline double joint_error(const Tolerances& t, int leg, double with = 0.0) {
  const LegEnds ends = leg_ends(leg);
  for (const int joint : {ends.from, ends.to})
    if (joint != point_s) with = detail::above(with + t.joints[at_index(joint)]);
  return with;
}
/// How far the length of a leg may be from that of the drawing, at every pose: an error of a joint counts along the
/// leg.
inline double reading_error(const Tolerances& t, int leg) {
  return joint_error(t, leg, t.legs[leg]);
}

/// One where a number is large: each joint is moved to the end of its ball where the slope of `value`, a function of a
/// geometry, leads.
template <class Value>
Geometry worst_machine(const PosedRobot& machine, const Value& value) {
  const Geometry& g = machine.geometry;
  using Joints = std::array<Triple, 4>;
  const Joints drawn{g.base_external(), g.base_internal(), g.platform_external(), g.platform_internal()};
  const auto built = [](const Joints& j) { return Geometry(j[0], j[1], j[2], j[3]); };
  Joints worst = drawn;
  try {
    for (std::size_t joint = 0; joint < machine.tolerances.joints.size(); ++joint) {
      const double radius = machine.tolerances.joints[joint] * (1.0 - 0x1p-40);
      if (!(radius > 0.0)) continue;
      Vec3 slope;
      for (Eigen::Index k = 0; k < 3; ++k) {
        Joints one = drawn, other = drawn;
        one[joint / 3][joint % 3][k] += radius;
        other[joint / 3][joint % 3][k] -= radius;
        slope[k] = value(built(one)) - value(built(other));
      }
      if (slope.allFinite() && slope.norm() > 0.0) worst[joint / 3][joint % 3] += radius * slope.normalized();
    }
    return built(worst);
  } catch (const InvalidArgument&) {  // tolerances as large as a plate
    return g;
  }
}

}  // namespace ninedof::over_region
