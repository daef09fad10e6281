#pragma once
/// A region of every shape, with tilts and yaws.

#include <array>

#include "ninedof/domains/region.hpp"

namespace regions {

inline constexpr std::array shapes{ninedof::Region::Shape::box, ninedof::Region::Shape::ball,
                                   ninedof::Region::Shape::cylinder, ninedof::Region::Shape::path};

inline ninedof::Region region_of(ninedof::Region::Shape shape) {
  using ninedof::Vec3;
  using Shape = ninedof::Region::Shape;
  ninedof::Region out;
  out.shape = shape;
  out.size = Vec3(0.3, shape == Shape::box ? 0.2 : 0.0, shape == Shape::ball ? 0.0 : 0.25);
  if (shape == Shape::path) out.corners = {Vec3(-0.3, 0.1, 0.0), Vec3(0.2, 0.1, 0.1), Vec3(0.2, -0.2, 0.2)};
  out.tilt = 0.25;
  out.yaw = 0.3;
  return out;
}

}  // namespace regions
