#include "position/sharpen.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>

#include "kinematics/closure.hpp"
#include "math/numbers.hpp"
#include "math/twofold.hpp"
#include "position/polish_rotation.hpp"
#include "position/rotation_problem.hpp"

namespace ninedof {
namespace {

constexpr double equation_rounding = 8.0 * eps;
constexpr double small_error = 1e-12;        // of a mode; the bounds are wide, and few modes exceed it
constexpr double longest_correction = 1e-4, wide = 100.0;  // rad, or of the longest leg; times the error that is known
constexpr double shrinking = 0.1;  // largest ratio of a correction to the one before
constexpr double no_correction = eps;
constexpr int most_corrections = 12;

using Point = std::array<Twofold, 3>;

Point point(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Twofold dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec3 rounded(const Point& a) {
  return {a[0].high, a[1].high, a[2].high};
}

/// A configuration in twice the precision; the quaternion need not have unit length.
struct Precise {
  Twofold w;
  Point v, p, s;

  explicit Precise(const Configuration& c) : p(point(c.position)), s(point(c.internal_point)) {
    const Eigen::Quaterniond q(c.rotation);
    w = q.w();
    v = point(q.vec());
  }

  std::array<Point, 3> rotation() const {
    const Twofold ww = w * w, xx = v[0] * v[0], yy = v[1] * v[1], zz = v[2] * v[2];
    const Twofold xy = v[0] * v[1], yz = v[1] * v[2], zx = v[2] * v[0], wx = w * v[0], wy = w * v[1], wz = w * v[2];
    const Twofold unit = inverse(ww + xx + yy + zz), two = unit + unit;
    return {{{unit * (ww + xx - yy - zz), two * (xy - wz), two * (zx + wy)},
             {two * (xy + wz), unit * (ww - xx + yy - zz), two * (yz - wx)},
             {two * (zx - wy), two * (yz + wx), unit * (ww - xx - yy + zz)}}};
  }

  void move(const Vec3& turn, const Vec3& dp, const Vec3& ds) {
    const Point half = point(0.5 * turn), old = v;
    const Twofold w0 = w;
    w = w0 - dot(half, old);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      v[i] = old[i] + w0 * half[i] + (half[j] * old[k] - half[k] * old[j]);
    }
    p = p + point(dp);
    s = s + point(ds);
  }
};

Point turned(const std::array<Point, 3>& rotation, const Vec3& joint) {
  const Point j = point(joint);
  return {dot(rotation[0], j), dot(rotation[1], j), dot(rotation[2], j)};
}

Configuration rounded(const Precise& c, const std::array<Point, 3>& rotation) {
  Configuration out{rounded(c.p), Mat3(), rounded(c.s)};
  for (std::size_t i = 0; i < 3; ++i) out.rotation.row(static_cast<Eigen::Index>(i)) = rounded(rotation[i]);
  return out;
}

/// Half of what is missing to the squared length of a leg.
double missing(double length, const Point& leg) {
  return 0.5 * (Twofold::product(length, length) - dot(leg, leg)).high;
}

/// Empty where the first correction is longer than that or they do not shrink.
std::optional<Configuration> corrected(const Geometry& g, const Vec9& leg_lengths, const Configuration& mode,
                                       double longest) {
  const double unit = leg_lengths.maxCoeff();
  Precise at(mode);
  double last = longest / shrinking;
  for (int k = 0; k < most_corrections; ++k) {
    const std::array<Point, 3> rotation = at.rotation();
    const Configuration here = rounded(at, rotation);
    std::array<double, 3> external{};
    std::array<Lanes, 3> internal;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto leg = static_cast<Eigen::Index>(i);
      const Point x = at.p + turned(rotation, g.platform_external()[i]) - point(g.base_external()[i]);
      const Point y = at.s - at.p - turned(rotation, g.platform_internal()[i]);
      const Point z = at.s - point(g.base_internal()[i]);
      external[i] = missing(leg_lengths[leg], x);
      internal[i] = {missing(leg_lengths[leg + 6], z), missing(leg_lengths[leg + 3], y)};
    }
    // The derivatives of half the squared lengths are those of the three systems of the velocities.
    const ClosureSolver solver(g, here);
    const ClosureSolver::Solution v = solver.solve(internal, external);
    const Vec3 turn = vec3(v.angular), ds = vec3(v.o), dp = vec3(v.at_o + cross(solver.legs.y, v.angular));
    if (!(turn.allFinite() && dp.allFinite() && ds.allFinite())) return std::nullopt;
    const double size = std::max({turn.norm(), dp.norm() / unit, ds.norm() / unit});
    if (size <= no_correction) return here;
    if (!(size <= shrinking * last)) return std::nullopt;
    at.move(turn, dp, ds);
    last = size;
  }
  return std::nullopt;
}

double separation_of(const Geometry& g, const Vec3& external_lengths, const Configuration& c) {
  const Vec3 o = c.rotation.transpose() * (c.internal_point - c.position);
  const ScaledRotationProblem problem = rotation_problem(g, {c.internal_point, o}, external_lengths);
  return 1.0 / RotationResidual(problem.unit, c.rotation).inverse_norm();
}

}  // namespace

void sharpen(const Geometry& g, const Vec9& leg_lengths, double error, Configuration& mode, double& separation) {
  const double known = (error + equation_rounding) / separation;
  if (known <= small_error) return;
  const std::optional<Configuration> found =
      corrected(g, leg_lengths, mode, std::min(longest_correction, wide * known));
  if (!found) return;
  mode = *found;
  separation = separation_of(g, leg_lengths.head<3>(), mode);
}

}  // namespace ninedof
