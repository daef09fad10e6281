#include "polish_rotation.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "rows_of.hpp"

namespace ninedof {
namespace {

constexpr double longest_step = 0.5;       // rad
constexpr double settled = 4.0 * std::numeric_limits<double>::epsilon();
constexpr double last_step = 1e-8;         // rad: the square of such a step is below rounding
constexpr double negligible_step = 1e-15;  // rad
constexpr double least_damping = 1e-6, most_damping = 1e3;

/// A quaternion of any length but zero: turning it needs no square root.
struct FreeQuaternion {
  double w;
  Vec3 v;

  /// Turned by the rotation vector `step` from the left, to second order in it.
  FreeQuaternion turned(const Vec3& step) const {
    const Vec3 half = 0.5 * step;
    return {w - half.dot(v), v + w * half + half.cross(v)};
  }
  Mat3 matrix() const {
    const double scale = 2.0 / (w * w + v.squaredNorm());
    const Vec3 sv = scale * v, sw = w * sv;
    const double xx = sv.x() * v.x(), yy = sv.y() * v.y(), zz = sv.z() * v.z();
    const double xy = sv.x() * v.y(), yz = sv.y() * v.z(), zx = sv.z() * v.x();
    Mat3 m;
    m << 1.0 - (yy + zz), xy - sw.z(), zx + sw.y(),  //
        xy + sw.z(), 1.0 - (xx + zz), yz - sw.x(),   //
        zx - sw.y(), yz + sw.x(), 1.0 - (xx + yy);
    return m;
  }
};

FreeQuaternion quaternion(const Mat3& rotation) {
  const Eigen::Quaterniond q(rotation);
  return {q.w(), q.vec()};
}

Vec3 shortened(const Vec3& step) {
  const double squared = step.squaredNorm();
  return squared > longest_step * longest_step ? Vec3(step * (longest_step / std::sqrt(squared))) : step;
}

Vec3 levenberg_step(const RotationResidual& at, double damping) {
  const Mat3 j = rows_of(at.row);
  const Mat3 normal = j.transpose() * j + damping * Mat3::Identity();
  return -(normal.inverse() * (j.transpose() * at.value));
}

}  // namespace

RotationResidual::RotationResidual(const RotationProblem& problem, const Mat3& rotation) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 turned_w = rotation * problem.w[i];
    row[i] = turned_w.cross(problem.d[i]);
    const auto k = static_cast<Eigen::Index>(i);
    value[k] = problem.d[i].dot(turned_w) - problem.c[k];
  }
  adjugate = {row[1].cross(row[2]), row[2].cross(row[0]), row[0].cross(row[1])};
  determinant = row[0].dot(adjugate[0]);
}

double RotationResidual::inverse_norm() const {
  // The largest eigenvalue of the Gram matrix of the adjugate: in closed form nothing is lost in the largest.
  const auto& [a, b, c] = adjugate;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
  const double ab = a.dot(b), bc = b.dot(c), ca = c.dot(a);
  const double mean = (aa + bb + cc) / 3.0;
  const double da = aa - mean, db = bb - mean, dc = cc - mean;
  const double p2 = (da * da + db * db + dc * dc + 2.0 * (ab * ab + bc * bc + ca * ca)) / 6.0;
  double top = mean;
  if (p2 > 0.0) {
    const double p = std::sqrt(p2);
    const double det = da * (db * dc - bc * bc) - ab * (ab * dc - bc * ca) + ca * (ab * bc - db * ca);
    top += 2.0 * p * std::cos(std::acos(std::clamp(0.5 * det / (p2 * p), -1.0, 1.0)) / 3.0);
  }
  return std::sqrt(top) / std::abs(determinant);
}

PolishedRotation polish_rotation(const RotationProblem& problem, const Mat3& start, const RotationResidual& at_start,
                                 int most_steps) {
  FreeQuaternion q = quaternion(start);
  PolishedRotation best{start, at_start};
  double residual = at_start.largest(), damping = 0.0;
  for (int k = 0; k < most_steps && damping < most_damping; ++k) {
    const Vec3 step = shortened(damping == 0.0 ? best.at.newton_step() : levenberg_step(best.at, damping));
    const FreeQuaternion candidate = q.turned(step);
    const Mat3 rotation = candidate.matrix();
    const RotationResidual at(problem, rotation);
    const double now = at.largest();
    if (now < residual || (k == 0 && now <= settled)) {  // the first step also makes the matrix orthogonal
      q = candidate;
      best = {rotation, at};
      residual = now;
      damping = 0.0;
      if (step.squaredNorm() < last_step * last_step) break;
    } else {
      if (residual <= settled || step.squaredNorm() < negligible_step * negligible_step) break;
      damping = damping == 0.0 ? least_damping : 10.0 * damping;
    }
  }
  return best;
}

}  // namespace ninedof
