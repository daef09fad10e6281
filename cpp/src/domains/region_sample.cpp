#include "ninedof/domains/region_sample.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "math/splitmix.hpp"

namespace ninedof {
namespace {

using std::numbers::pi;

/// Point n of a low-discrepancy sequence of the unit cube (Kronecker, of the root of x^7 = x + 1); from the middle of
/// the cube for seed 0.
Vec6 cube_point(long n, std::uint64_t seed) {
  constexpr double root = 1.1127756842787055;
  Vec6 out;
  double step = 1.0;
  for (Eigen::Index k = 0; k < 6; ++k) {
    step /= root;
    const double begin = seed == 0 ? 0.5 : uniform_from(stream(seed, static_cast<std::uint64_t>(k)));
    const double x = begin + static_cast<double>(n + 1) * step;
    out[k] = x - std::floor(x);
  }
  return out;
}

Eigen::Vector2d direction(double turn) {
  return {std::cos(2.0 * pi * turn), std::sin(2.0 * pi * turn)};
}

}  // namespace

Vec6 even_sample(const Region& region, long n, std::uint64_t seed) {
  const Vec6 cube = cube_point(n, seed);
  Vec6 at = region.reach().cwiseProduct(Vec6(2.0 * cube.array() - 1.0));
  at.segment<2>(3) = region.tilt * std::sqrt(cube[3]) * direction(cube[4]);
  if (region.shape == Region::Shape::cylinder) at.head<2>() = region.size[0] * std::sqrt(cube[0]) * direction(cube[1]);
  if (region.shape == Region::Shape::ball) {
    const double z = 2.0 * cube[1] - 1.0;
    at.head<3>() << std::sqrt(1.0 - z * z) * direction(cube[2]), z;
    at.head<3>() *= region.size[0] * std::cbrt(cube[0]);
  }
  return at;
}

Vec6 region_sample(const Region& region, long n, std::uint64_t seed) {
  constexpr double outward = 1.25;  // what is drawn beyond the region is moved to its boundary
  if (n == 0) return Vec6::Zero();
  return region.nearest(outward * region.reach().cwiseProduct(Vec6(2.0 * cube_point(n, seed).array() - 1.0)));
}

std::vector<Vec6> region_corners(const Region& region, int turns) {
  const Vec6 reach = region.reach();
  std::vector<Vec6> out;
  for (unsigned corner = 0; corner < 16; ++corner) {
    Vec6 at = Vec6::Zero();
    bool repeated = false;
    for (unsigned k = 0; k < 4; ++k) {
      const Eigen::Index c = k < 3 ? k : 5;
      const bool high = (corner >> k & 1U) != 0;
      at[c] = high ? reach[c] : -reach[c];
      repeated |= high && reach[c] == 0.0;
    }
    for (int turn = 0; turn < (region.tilt > 0.0 ? turns : 1) && !repeated; ++turn) {
      at.segment<2>(3) = region.tilt * direction(static_cast<double>(turn) / turns);
      out.push_back(region.nearest(at));
    }
  }
  return out;
}

Vec6 region_moved(const Region& region, Vec6 at, int move, double step) {
  if (move < 6) {
    at[move] += step * region.reach()[move];
    return at;
  }
  const double angle = step * pi;
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
