#include "ninedof/math/rotation.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "ninedof/math/error.hpp"

namespace ninedof {

Mat3 skew(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Mat3 exp_rotation(const Vec3& w) {
  const double angle = w.norm();
  if (angle == 0.0) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Mat3 turn_by_vector(const Vec3& w) {
  // 1 + (1 - cos a) / a^2 [w] + (a - sin a) / a^3 [w]^2, both factors without cancellation near 0.
  const double square = w.squaredNorm(), angle = std::sqrt(square), half = 0.5 * angle;
  const double part = half > 0.0 ? std::sin(half) / half : 1.0, first = 0.5 * part * part;
  const double second = angle > 0.1 ? (angle - std::sin(angle)) / (square * angle)
                                    : 1.0 / 6.0 - square / 120.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0));
  const Mat3 cross = skew(w);
  return Mat3::Identity() + first * cross + second * cross * cross;
}

Vec3 log_rotation(const Mat3& q) {
  Eigen::Vector4d wxyz = quaternion_from_rotation(q);
  const Vec3 v = wxyz.tail<3>();
  const double sine = v.norm();  // of half the angle; 2 atan2 keeps full accuracy near 0 and near pi
  if (sine == 0.0) return Vec3::Zero();
  return (2.0 * std::atan2(sine, wxyz[0]) / sine) * v;
}

Mat3 rotation_about_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 q;
  q << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return q;
}

Mat3 rotation_from_quaternion(const Eigen::Vector4d& wxyz) {
  const double norm = wxyz.stableNorm();
  if (!std::isfinite(norm) || norm == 0.0)
    throw InvalidArgument("quaternion", "norm " + format_number(norm), "a finite quaternion that is not zero");
  const Eigen::Vector4d unit = wxyz / norm;
  return Eigen::Quaterniond(unit[0], unit[1], unit[2], unit[3]).toRotationMatrix();
}

Eigen::Vector4d quaternion_from_rotation(const Mat3& q) {
  const Eigen::Quaterniond k = Eigen::Quaterniond(q).normalized();
  const double sign = k.w() < 0.0 ? -1.0 : 1.0;
  return sign * Eigen::Vector4d(k.w(), k.x(), k.y(), k.z());
}

void require_rotation(const std::string& argument, const Mat3& q) {
  if (!q.allFinite()) throw InvalidArgument(argument, "a non-finite entry", "a rotation matrix");
  const double residual = (q.transpose() * q - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (residual > 1e-9)
    throw InvalidArgument(argument, "max |Q^T Q - 1| = " + format_number(residual), "an orthogonal matrix (to 1e-9)");
  const double determinant = q.col(0).cross(q.col(1)).dot(q.col(2));
  if (determinant < 0.0)
    throw InvalidArgument(argument, "determinant -1", "a proper rotation, determinant +1 (this is a reflection)");
}

}  // namespace ninedof
