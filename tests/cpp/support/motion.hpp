#pragma once
/// Motions to second order in time, for the tests of accelerations and of the derivative of J'.

#include "ninedof/kinematics/acceleration.hpp"
#include "support/oracle.hpp"
#include "support/support.hpp"

namespace support {

/// What a robot does to second order in time.
struct Motion {
  ninedof::Velocity v;
  ninedof::Acceleration a;
};

inline Motion random_motion(Random& random) {
  const auto three = [&] { return random.matrix<Vec3>(); };
  const ninedof::Velocity v{three(), three(), three()};
  return {v, {three(), three(), three()}};
}

inline Vec9 stacked(const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec9 out;
  out << a, b, c;
  return out;
}
inline Vec9 stacked(const ninedof::Velocity& v) {
  return stacked(v.omega, v.pdot, v.sdot);
}
inline Vec9 stacked(const ninedof::Acceleration& a) {
  return stacked(a.alpha, a.pddot, a.sddot);
}

/// How much of an answer rounding may take: the conditioning of the 9x9 matrix of rates.
inline double conditioning_of(const Robot& robot) {
  return oracle::conditioning_of_rates(robot.geometry, robot.configuration);
}

}  // namespace support
