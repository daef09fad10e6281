#pragma once
/// Loads on the platform from Python.

#include <vector>

#include "ninedof/statics/statics.hpp"

namespace ninedof::python {

/// Of rows (moment about p, force), base axes.
inline std::vector<Load> loads_from(const std::vector<Vec6>& rows) {
  std::vector<Load> out;
  for (const Vec6& row : rows) out.push_back({row.head<3>(), row.tail<3>(), Vec3::Zero()});
  return out;
}

}  // namespace ninedof::python
