#pragma once
/// A continuous set of poses about the neutral one: every tilt and yaw at every position.

#include <vector>

#include "ninedof/domains/pose.hpp"
#include "ninedof/robot/configuration.hpp"

namespace ninedof {

/// Derivatives of a pose by its six coordinates in a region.
struct PoseSlopes {
  using Columns = Eigen::Matrix<double, 3, 6>;
  Columns position = Columns::Zero();  ///< of the shift of p
  Columns turn = Columns::Zero();      ///< turns of the platform about base axes
  Columns internal = Columns::Zero();  ///< of the shift of s
};

struct Region {
  enum class Shape {
    box,       ///< `size` has its half edges
    ball,      ///< size[0] is its radius
    cylinder,  ///< about z: size[0] is its radius, size[2] its half height
    path,      ///< straight between `corners`
  };
  Shape shape = Shape::box;
  Vec3 size = Vec3::Zero();
  std::vector<Vec3> corners;
  double tilt = 0.0;    ///< greatest angle of a rotation about a horizontal axis, radians
  double yaw = 0.0;     ///< rotations about z, before the tilt, go from minus to plus this
  bool shifted = true;  ///< whether s moves with p (s - p as at the neutral pose) or is held
  bool placed = false;  ///< whether s is placed anew at every pose: then shifts of s count from the neutral one
  bool in_zp = false;   ///< whether positions are in fractions of zp
  double tool_height = 0.0;  ///< of p above the plate at home: zp is the height of p less this

  /// A pose has six coordinates: the shift of p (on a path only the first, from -1 to 1), the two horizontal components
  /// of the tilt vector, and the yaw. Their greatest moduli, 0 for those that are fixed:
  Vec6 reach() const;
  /// The nearest coordinates in the region.
  Vec6 nearest(Vec6 at) const;
  /// The derivatives of `nearest`.
  Mat6 nearest_slopes(const Vec6& at) const;
  Pose pose(const Vec6& at) const;
  /// The coordinates of a pose in the unit of the region, which may lie beside it; on a path those of the nearest
  /// point.
  Vec6 coordinates(const Pose& pose) const;
  /// The derivatives of `pose`; at a corner of a path those of the way that ends there.
  PoseSlopes slopes(const Vec6& at) const;
  /// The straight way of a path on which a first coordinate lies, and those of the corners at its ends.
  struct Straight {
    int way;
    double from, to;
  };
  Straight straight(double first) const;
  /// The unit of its positions: zp, or 1.
  double unit(const Configuration& neutral) const { return in_zp ? neutral.position[2] - tool_height : 1.0; }
  /// That pose of a design.
  Configuration configuration(const Vec6& at, const Configuration& neutral) const;

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;
};

}  // namespace ninedof
