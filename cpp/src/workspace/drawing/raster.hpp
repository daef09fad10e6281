#pragma once
/// What is done to a raster as a whole. Beyond its ends the values are those at the ends, unless others are given.

#include <optional>

#include "ninedof/workspace/surface.hpp"

namespace ninedof {

/// From one point to the next along each axis, in the list of values.
inline std::array<std::size_t, 3> strides(const std::array<std::size_t, 3>& count) {
  return {count[1] * count[2], count[2], 1};
}

/// Calls visit(i, j, k, number) for the points of a raster of `count` points in a list of those of `whole`.
template <class Visit>
void for_each_point(const std::array<std::size_t, 3>& count, const std::array<std::size_t, 3>& whole,
                    const Visit& visit) {
  const auto stride = strides(whole);
  for (std::size_t i = 0; i < count[0]; ++i)
    for (std::size_t j = 0; j < count[1]; ++j)
      for (std::size_t k = 0; k < count[2]; ++k) visit(i, j, k, i * stride[0] + j * stride[1] + k);
}

/// The raster with one more point on every side: of the value `outside`, or of that of the nearest point.
Raster padded(const Raster& raster, std::optional<double> outside);

/// The values at twice as many points along each axis, linear between the points.
Raster refined(const Raster& raster);

/// The values averaged with those of their neighbours, by 1/4, 1/2 and 1/4 along each axis.
Raster averaged(const Raster& raster);

}  // namespace ninedof
