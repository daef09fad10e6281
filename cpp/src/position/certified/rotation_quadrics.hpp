#pragma once
/// The rotations that fit the external legs as common points of three quadrics, with bounds of every coefficient.

#include "ninedof/robot/geometry.hpp"
#include "position/certified/point_bounds.hpp"
#include "position/certified/quadratics.hpp"

namespace ninedof {

/// A quaternion (w, x, y, z) up to a factor: a point of projective space.
using QuaternionBounds = std::array<Interval, 4>;

/// The other components where component `chart` is 1.
inline std::array<std::size_t, 3> free_in(std::size_t chart) {
  return {chart > 0 ? 0U : 1U, chart > 1 ? 1U : 2U, chart > 2 ? 2U : 3U};
}

/// z^T K_i z = 0, i = 1, 2, 3, for the quaternions z of the rotations Q with d_i . Q w_i = c_i.
class RotationQuadrics {
 public:
  /// For O within s in the base frame and o in the platform frame.
  RotationQuadrics(const Geometry& g, const PointBounds& s, const PointBounds& o, const Vec3& external_lengths);

  bool impossible() const { return impossible_; }  ///< whether a leg is too long or too short whatever the rotation
  bool known() const { return known_; }  ///< false if O may lie on an external joint

  /// The three functions of t for z = centre + t, where t has no component along `chart`.
  Quadratics around(const std::array<double, 4>& centre, std::size_t chart) const;

 private:
  std::array<std::array<QuaternionBounds, 4>, 3> k_;
  bool impossible_ = false, known_ = true;
};

}  // namespace ninedof
