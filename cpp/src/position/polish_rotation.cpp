#include "position/polish_rotation.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "math/numbers.hpp"
#include "math/rows_of.hpp"

namespace ninedof {
namespace {

constexpr double residual_rounding = 4.0 * eps;  // of d . Q w - c: no step reduces it further
constexpr double settled = 16.0 * eps;           // below it only Newton's steps are tried
constexpr double longest_step = 0.5;             // rad
constexpr double last_step = 1e-8;               // rad: the square of such a step is below rounding
constexpr double natural = 0.75;                 // required reduction of |J^-1 f| where |f| does not fall
constexpr double least_progress = 0.999;         // of |f|^2
constexpr int most_stalled = 5;                  // steps without progress

/// A quaternion that need not have unit length: rotating it needs no square root.
struct FreeQuaternion {
  double w;
  Vec3 v;

  /// Rotated from the left by the rotation vector `step`, to second order in it.
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

/// -(J^T J + mu)^-1 J^T f: a descent direction, shorter for larger mu.
Vec3 levenberg_step(const RotationResidual& at, double mu) {
  const Mat3 j = rows_of(at.row);
  const Mat3 normal = j.transpose() * j + mu * Mat3::Identity();
  return -(normal.inverse() * (j.transpose() * at.value));
}

/// The current iterate.
struct State {
  FreeQuaternion quaternion;
  PolishedRotation here;
  double squared;  ///< |f|^2
  double step2;    ///< squared length of the last step

  State(const RotationProblem& problem, const FreeQuaternion& q, double last) : State(q, q.matrix(), problem, last) {}
  State(const FreeQuaternion& q, const PolishedRotation& p)
      : quaternion(q), here(p), squared(p.at.value.squaredNorm()), step2(1.0) {}

 private:
  State(const FreeQuaternion& q, const Mat3& rotation, const RotationProblem& problem, double last)
      : quaternion(q), here{rotation, {problem, rotation}}, squared(here.at.value.squaredNorm()), step2(last) {}
};

State moved(const RotationProblem& problem, const State& s, const Vec3& step) {
  const Vec3 allowed = shortened(step);
  return {problem, s.quaternion.turned(allowed), allowed.squaredNorm()};
}

/// Newton's step if it reduces |f| or, in a curved valley, |J^-1 f|; else the longest Levenberg step that reduces |f|.
/// `best` keeps the best iterate where a step increases |f|. Returns whether a step was made.
bool improve(const RotationProblem& problem, State& s, double least, std::optional<State>& best) {
  const Vec3 newton = s.here.at.newton_step();
  if (newton.allFinite()) {
    const State next = moved(problem, s, newton);
    const bool lower = next.squared < s.squared;
    if (!lower && s.here.residual() <= settled) return false;
    if (lower || s.here.at.newton_step(next.here.at.value).norm() < natural * std::min(newton.norm(), longest_step)) {
      if (!lower && s.squared <= least) best = s;
      s = next;
      return true;
    }
  }
  for (double mu = 1e-3 * std::sqrt(s.squared); mu > 0.0 && mu < 10.0; mu *= 10.0) {
    const State next = moved(problem, s, levenberg_step(s.here.at, mu));
    if (!(next.squared < s.squared)) continue;
    s = next;
    return true;
  }
  return false;
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
  if (determinant == 0.0) return infinity;
  // The largest eigenvalue of the Gram matrix of the adjugate. The closed form is accurate for the largest eigenvalue.
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
  const FreeQuaternion q = quaternion(start);
  State s(q, {start, at_start});
  if (!(s.here.residual() > settled)) return State(problem, q, 0.0).here;  // the rotation made orthogonal
  std::optional<State> best;  // set only if a step has increased |f|
  double least = s.squared;
  int stalled = 0;
  for (int k = 0; k < most_steps && stalled < most_stalled && s.here.residual() > residual_rounding; ++k) {
    if (!improve(problem, s, least, best)) break;
    stalled = s.squared < least_progress * least ? 0 : stalled + 1;
    least = std::min(least, s.squared);
    if (s.step2 < last_step * last_step) break;
  }
  return best && best->squared < s.squared ? best->here : s.here;
}

}  // namespace ninedof
