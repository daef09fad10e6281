#include "position/two_leg_rotations.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ninedof {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double cosine_rounding = 1e-7;  // rad: half the digits, since angles come from cosines

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Least angle between points of two circles on the unit sphere: angular radii a and b, angle `apart` between their
/// centres.
double least_angle(double apart, double a, double b) {
  return std::max({0.0, apart - a - b, std::abs(a - b) - apart, apart + a + b - 2.0 * pi});
}

}  // namespace

bool two_legs_fit(const RotationProblem& problem, std::size_t i, std::size_t j) {
  // Q w_i lies on a circle about d_i and Q w_j on one about d_j, with the angle of w_i and w_j between them. Circles
  // are connected, so all angles between the least and the largest occur. The largest is pi minus the least to the
  // opposite circle.
  const double a = std::acos(std::clamp(problem.c[static_cast<Eigen::Index>(i)], -1.0, 1.0));
  const double b = std::acos(std::clamp(problem.c[static_cast<Eigen::Index>(j)], -1.0, 1.0));
  const double base = angle(problem.d[i], problem.d[j]), platform = angle(problem.w[i], problem.w[j]);
  return platform >= least_angle(base, a, b) - cosine_rounding &&
         platform <= pi - least_angle(pi - base, a, b) + cosine_rounding;
}

}  // namespace ninedof
