#pragma once
/// Enclosures of the two motions of a point on the path p + t pdot, exp(t omega) Q, s + t sdot.

#include <Eigen/Geometry>
#include <cmath>

#include "math/numbers.hpp"
#include "math/roots/enclosure.hpp"

namespace ninedof {

/// start + t velocity. `size` is that of the coordinates that `start` is a sum of, `error` its error beyond rounding.
struct Line {
  Vec3 start, velocity;
  double size, error = 0.0;

  Enclosure<Vec3> at(double t, double window) const {
    const double speed = velocity.norm();
    Enclosure<Vec3> out{{start + t * velocity, velocity, Vec3::Zero()},
                        {4.0 * eps * (size + t * speed) + error, 2.0 * eps * speed, 0.0},
                        {infinity, speed, 0.0, 0.0}};
    detail::tighten(out, window);
    return out;
  }
};

/// exp(t omega) v by Rodrigues' formula; v is a vector of the platform in base axes, `v_error` beyond rounding.
struct Turning {
  Turning(const Vec3& v, const Vec3& omega, double v_error = 0.0) : rate(omega.norm()), size(v.norm()), error(v_error) {
    const Vec3 axis = rate > 0.0 ? Vec3(omega / rate) : Vec3(Vec3::Zero());
    along = axis.dot(v) * axis;
    across = v - along;
    around = axis.cross(v);
  }

  Enclosure<Vec3> at(double t, double window) const {
    const double angle = rate * t, c = std::cos(angle), s = std::sin(angle);
    const Vec3 part = c * across + s * around;
    const double off = 8.0 * eps * (1.0 + angle) * size + error, radius = around.norm() + 4.0 * eps * size;
    Enclosure<Vec3> out{{along + part, rate * (c * around - s * across), -0.5 * rate * rate * part},
                        {off, rate * off, rate * rate * off},
                        {infinity, rate * radius, 0.5 * rate * rate * radius, rate * rate * rate * radius / 6.0}};
    detail::tighten(out, window);
    return out;
  }

  double rate, size, error;
  Vec3 along, across, around;
};

}  // namespace ninedof
