#include "optimize/rule/rule_samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/numbers.hpp"
#include "ninedof/domains/region_sample.hpp"

namespace ninedof {
namespace {

constexpr long points_between = 800, points_of_path = 41;
constexpr int tilts_around = 8;

/// Evenly from minus to plus `reach`; zero alone where it is zero.
std::vector<double> spread_over(double reach, long count) {
  std::vector<double> out;
  for (long k = 0; k < count && reach > 0.0; ++k)
    out.push_back(reach * (2.0 * static_cast<double>(k) / static_cast<double>(count - 1) - 1.0));
  return out.empty() ? std::vector{0.0} : out;
}

/// Where on a path, from -1 to 1 by its length, the nearest point to another is.
double nearest_on_path(const std::vector<Vec3>& corners, const Vec3& point) {
  double length = 0.0, at = 0.0, least = infinity;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Vec3 way = corners[k] - corners[k - 1];
    const double size = way.norm();
    if (!(size > 0.0)) continue;
    const double along = std::clamp(way.dot(point - corners[k - 1]) / size, 0.0, size);
    if (const double away = (corners[k - 1] + along / size * way - point).norm(); away < least) {
      least = away;
      at = length + along;
    }
    length += size;
  }
  return length > 0.0 ? 2.0 * at / length - 1.0 : 0.0;
}

}  // namespace

std::vector<Vec6> first_rule_poses(const Region& region) {
  const Vec6 reach = region.reach();
  const long steps = region.shape == Region::Shape::path ? points_of_path : 3;
  std::vector<Eigen::Vector2d> tilts{Eigen::Vector2d::Zero()};
  for (int k = 0; k < tilts_around && region.tilt > 0.0; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / tilts_around;
    tilts.emplace_back(region.tilt * std::cos(turn), region.tilt * std::sin(turn));
  }
  std::vector<Vec6> out;
  for (const double x : spread_over(reach[0], steps))
    for (const double y : spread_over(reach[1], 3))
      for (const double z : spread_over(reach[2], 3))
        for (const Eigen::Vector2d& tilt : tilts)
          for (const double yaw : spread_over(reach[5], 3)) out.emplace_back(x, y, z, tilt[0], tilt[1], yaw);
  const std::vector<Vec6> between = sampled_poses(region, 0, points_between);
  out.insert(out.end(), between.begin(), between.end());
  return out;
}

std::vector<Vec6> sampled_poses(const Region& region, long first, long count) {
  std::vector<Vec6> out;
  for (long n = first; n < first + count; ++n) out.push_back(region_sample(region, n, 0));
  return out;
}

Vec6 region_coordinates(const Region& region, double unit, const MetAt& met) {
  Vec6 out;
  out << met.shift / unit, met.tilt.head<2>(), met.yaw;
  if (region.shape == Region::Shape::path) out.head<3>() << nearest_on_path(region.corners, met.shift / unit), 0.0, 0.0;
  return out;
}

}  // namespace ninedof
