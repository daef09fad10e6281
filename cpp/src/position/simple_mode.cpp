#include "position/simple_mode.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "math/linear/jacobi_svd.hpp"
#include "math/rows_of.hpp"

namespace ninedof {
namespace {

constexpr double farthest = 0.1;  // rad: beyond it the path of least change is not followed
constexpr int corrections = 3;    // back to that path

Mat3 turned(const Vec3& by, const Mat3& rotation) {
  const double angle = by.norm();
  return angle > 0.0 ? Mat3(Eigen::AngleAxisd(angle, by / angle).toRotationMatrix() * rotation) : rotation;
}

}  // namespace

bool linear_along_weakest(const RotationProblem& problem, const PolishedRotation& mode, double separation,
                          double error) {
  const double reach = error / separation;
  if (!(reach <= farthest)) return false;
  // Turn by `reach` along the weakest direction, on the path where the other two equations hold. There the third one
  // must have changed by `error`, as the linear equations predict.
  const auto [size, u, v] = jacobi_svd(rows_of(mode.at.row));
  if (!(size[1] * size[1] >= 3.5 * error)) return false;  // two weak directions
  for (const double side : {1.0, -1.0}) {
    Mat3 q = turned(side * reach * v.col(2), mode.rotation);
    for (int k = 0; k < corrections; ++k) {
      const Vec3 f = RotationResidual(problem, q).value;
      q = turned(-(u.col(0).dot(f) / size[0]) * v.col(0) - (u.col(1).dot(f) / size[1]) * v.col(1), q);
    }
    const double changed = side * u.col(2).dot(RotationResidual(problem, q).value - mode.at.value);
    if (!(std::abs(changed - error) <= 0.5 * error)) return false;
  }
  return true;
}

Vec3 weakest_direction(const RotationResidual& at) {
  return jacobi_svd(rows_of(at.row)).v.col(2);
}

}  // namespace ninedof
