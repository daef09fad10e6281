/// Declared in ninedof/workspace/workspace.hpp.

#include <cmath>
#include <numbers>

#include "ninedof/math/error.hpp"
#include "ninedof/math/rotation.hpp"
#include "ninedof/workspace/workspace.hpp"
#include "workspace/sequence.hpp"

namespace ninedof {
namespace {

using std::numbers::pi;

/// The angle that contains the share u of the Haar measure within `most`: t - sin t = u (most - sin most).
double angle_of_share(double u, double most) {
  const double wanted = u * (most - std::sin(most));
  double low = 0.0, high = most;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (middle - std::sin(middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<Mat3> spread_rotations(int count, double angle) {
  if (count < 1) throw InvalidArgument("count", std::to_string(count), "at least 1");
  if (!(angle > 0.0 && angle <= pi * (1.0 + 1e-12)))
    throw InvalidArgument("angle", format_number(angle), "radians in (0, pi]");
  const bool on_boundary = angle < pi * (1.0 - 1e-12);
  std::vector<Mat3> out{Mat3::Identity()};
  for (int n = 1; n < count; ++n) {
    const Vec3 u = sequence_point(n, Vec3::Zero());
    const double z = 1.0 - 2.0 * u[0], r = std::sqrt(std::max(0.0, 1.0 - z * z)), along = 2.0 * pi * u[1];
    const double turn = on_boundary && n % 2 == 1 ? angle : angle_of_share(u[2], angle);
    out.push_back(exp_rotation(turn * Vec3(r * std::cos(along), r * std::sin(along), z)));
  }
  return out;
}

}  // namespace ninedof
