#include "ninedof/domains/region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ninedof/math/error.hpp"
#include "ninedof/math/rotation.hpp"

namespace ninedof {
namespace {

/// The nearest vector to v that is not longer than `longest`.
template <class Vector>
Vector shortened(const Vector& v, double longest) {
  const double length = v.norm();
  return length > longest ? Vector(v * (longest / length)) : v;
}

/// The derivatives of `shortened`.
template <class Vector>
auto shortened_slopes(const Vector& v, double longest) {
  using Matrix = Eigen::Matrix<double, Vector::RowsAtCompileTime, Vector::RowsAtCompileTime>;
  const double length = v.norm();
  if (!(length > longest)) return Matrix(Matrix::Identity());
  return Matrix(longest / length * (Matrix::Identity() - v * v.transpose() / (length * length)));
}

/// A point of a path, its derivative by t, the way on which it lies, and the t of the corners at its ends.
struct PathPoint {
  Vec3 at, slope = Vec3::Zero();
  int way = 0;
  double from = 0.0, to = 1.0;
};

/// The point of a path through its corners, t from 0 to 1 by arc length; a corner belongs to the way that ends there.
PathPoint along(const std::vector<Vec3>& corners, double t) {
  double length = 0.0;
  for (std::size_t k = 1; k < corners.size(); ++k) length += (corners[k] - corners[k - 1]).norm();
  PathPoint out;
  double left = t * length, done = 0.0;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Vec3 way = corners[k] - corners[k - 1];
    const double step = way.norm();
    if (step > 0.0)
      out = {corners[k - 1] + left / step * way, length / step * way, static_cast<int>(k) - 1, done / length,
             (done + step) / length};
    if (left <= step && step > 0.0) return out;
    left -= step;
    done += step;
  }
  out.at = corners.back();
  return out;
}

/// The t of the point of a path that is nearest to a position.
double nearest_along(const std::vector<Vec3>& corners, const Vec3& at) {
  double done = 0.0, best = 0.0, least = (at - corners.front()).norm();
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Vec3 way = corners[k] - corners[k - 1];
    const double step = way.norm();
    const double part = step > 0.0 ? std::clamp((at - corners[k - 1]).dot(way) / (step * step), 0.0, 1.0) : 0.0;
    if (const double away = (corners[k - 1] + part * way - at).norm(); away < least) {
      least = away;
      best = done + part * step;
    }
    done += step;
  }
  return done > 0.0 ? best / done : 0.0;
}

}  // namespace

Vec6 Region::reach() const {
  Vec6 out;
  switch (shape) {
    case Shape::box: out.head<3>() = size; break;
    case Shape::ball: out.head<3>().setConstant(size[0]); break;
    case Shape::cylinder: out.head<3>() << size[0], size[0], size[2]; break;
    case Shape::path: out.head<3>() << 1.0, 0.0, 0.0; break;
  }
  out.tail<3>() << tilt, tilt, yaw;
  return out;
}

Vec6 Region::nearest(Vec6 at) const {
  const Vec6 most = reach();
  at = at.cwiseMax(-most).cwiseMin(most);
  if (shape == Shape::ball) at.head<3>() = shortened(Vec3(at.head<3>()), size[0]);
  if (shape == Shape::cylinder) at.head<2>() = shortened(Eigen::Vector2d(at.head<2>()), size[0]);
  at.segment<2>(3) = shortened(Eigen::Vector2d(at.segment<2>(3)), tilt);
  return at;
}

Mat6 Region::nearest_slopes(const Vec6& at) const {
  const Vec6 most = reach(), kept = at.cwiseMax(-most).cwiseMin(most);
  Mat6 out = (kept.array() == at.array() && most.array() > 0.0).cast<double>().matrix().asDiagonal();
  const auto round = [&](Eigen::Index first, const auto& v, double longest) {
    const Eigen::Index n = v.size();
    out.middleRows(first, n) = (shortened_slopes(v, longest) * out.middleRows(first, n)).eval();
  };
  if (shape == Shape::ball) round(0, Vec3(kept.head<3>()), size[0]);
  if (shape == Shape::cylinder) round(0, Eigen::Vector2d(kept.head<2>()), size[0]);
  round(3, Eigen::Vector2d(kept.segment<2>(3)), tilt);
  return out;
}

Pose Region::pose(const Vec6& at) const {
  Pose out;
  out.in_zp = in_zp;
  out.position = shape == Shape::path ? along(corners, 0.5 * (1.0 + at[0])).at : Vec3(at.head<3>());
  if (shifted) out.internal = out.position;
  const Vec3 turn(at[3], at[4], 0.0), about_z(0.0, 0.0, at[5]);
  if (at[5] == 0.0) out.rotation = turn;
  else if (turn.isZero(0.0)) out.rotation = about_z;
  else out.rotation = log_rotation(exp_rotation(turn) * exp_rotation(about_z));
  return out;
}

Vec6 Region::coordinates(const Pose& pose) const {
  Vec6 out;
  if (shape == Shape::path) out.head<3>() << 2.0 * nearest_along(corners, pose.position) - 1.0, 0.0, 0.0;
  else out.head<3>() = pose.position;
  const Mat3 q = exp_rotation(pose.rotation);
  const double sine = std::hypot(q(0, 2), q(1, 2));
  const double stretch = sine > 0.0 ? std::atan2(sine, q(2, 2)) / sine : 0.0;
  const Vec3 tilted(-stretch * q(1, 2), stretch * q(0, 2), 0.0);
  const Mat3 about_z = exp_rotation(-tilted) * q;
  out.tail<3>() << tilted.head<2>(), std::atan2(about_z(1, 0), about_z(0, 0));
  return out;
}

PoseSlopes Region::slopes(const Vec6& at) const {
  PoseSlopes out;
  if (shape == Shape::path) out.position.col(0) = 0.5 * along(corners, 0.5 * (1.0 + at[0])).slope;
  else out.position.leftCols<3>().setIdentity();
  if (shifted) out.internal = out.position;
  const Vec3 tilted(at[3], at[4], 0.0);
  out.turn.middleCols<2>(3) = turn_by_vector(tilted).leftCols<2>();
  out.turn.col(5) = exp_rotation(tilted).col(2);  // the yaw comes before the tilt, about an axis that it turns
  return out;
}

Region::Straight Region::straight(double first) const {
  const PathPoint point = along(corners, 0.5 * (1.0 + first));
  return {point.way, 2.0 * point.from - 1.0, 2.0 * point.to - 1.0};
}

Configuration Region::configuration(const Vec6& at, const Configuration& neutral) const {
  const Pose p = pose(at);
  const double by = unit(neutral);
  return {neutral.position + by * p.position, exp_rotation(p.rotation) * neutral.rotation,
          neutral.internal_point + by * p.internal};
}

void Region::validate() const {
  const auto require = [](const char* name, bool fine, double value, const char* expected) {
    if (!fine) throw InvalidArgument(std::string("objective.region.") + name, format_number(value), expected);
  };
  for (const double x : size) require("size", std::isfinite(x) && x >= 0.0, x, "finite numbers of at least 0");
  for (const auto& [name, angle] : {std::pair{"tilt", tilt}, std::pair{"yaw", yaw}})
    require(name, angle >= 0.0 && angle <= std::numbers::pi, angle, "an angle from 0 to pi");
  if (shape == Shape::path && corners.size() < 2)
    throw InvalidArgument("objective.region.path", std::to_string(corners.size()) + " corners", "at least two");
  require("tool_height", std::isfinite(tool_height), tool_height, "a finite number");
  for (const Vec3& corner : corners)
    if (!corner.allFinite()) throw InvalidArgument("objective.region.path", "a number that is not finite", "positions");
}

}  // namespace ninedof
