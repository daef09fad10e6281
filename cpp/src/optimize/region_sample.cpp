#include "optimize/region_sample.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "math/splitmix.hpp"

namespace ninedof {
namespace {

constexpr double outward = 1.25;  // samples are drawn from a region larger by this and moved to the nearest pose

/// Point n of a low-discrepancy sequence of the cube from -1 to 1 (Kronecker, of the root of x^7 = x + 1).
Vec6 sequence_point(long n, std::uint64_t seed) {
  constexpr double root = 1.1127756842787055;
  Vec6 out;
  double step = 1.0;
  for (Eigen::Index k = 0; k < 6; ++k) {
    step /= root;
    const double x = uniform_from(stream(seed, static_cast<std::uint64_t>(k))) + static_cast<double>(n + 1) * step;
    out[k] = 2.0 * (x - std::floor(x)) - 1.0;
  }
  return out;
}

}  // namespace

Vec6 region_sample(const Region& region, long n, std::uint64_t seed) {
  if (n == 0) return Vec6::Zero();
  const Vec6 drawn = outward * region.reach();
  return region.nearest(drawn.cwiseProduct(sequence_point(n, seed)));
}

Vec6 region_moved(const Region& region, Vec6 at, int move, double step) {
  if (move < 6) {
    at[move] += step * region.reach()[move];
    return at;
  }
  const double angle = step * std::numbers::pi;
  const auto turn = [&](Eigen::Index a, Eigen::Index b) {
    const Eigen::Vector2d v = Eigen::Rotation2Dd(angle) * Eigen::Vector2d(at[a], at[b]);
    at[a] = v[0];
    at[b] = v[1];
  };
  if (move == 6) turn(3, 4);
  else if (region.shape == Region::Shape::ball) turn(move == 7 ? 1 : 0, move == 9 ? 1 : 2);
  else if (region.shape == Region::Shape::cylinder && move == 9) turn(0, 1);
  return at;
}

}  // namespace ninedof
