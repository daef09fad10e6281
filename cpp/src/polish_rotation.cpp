#include "polish_rotation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace ninedof {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double rounding = 4.0 * eps;    // of d . Q w - c: no step lowers this but by chance
constexpr double settled = 16.0 * eps;    // below it Newton's steps alone are tried
constexpr double acceptable = 1e-13;      // largest residual of a solution
constexpr double longest_step = 0.5;      // radians
constexpr double least_progress = 0.999;  // of |f|^2
constexpr int patience = 5;               // steps without progress

/// Where the iteration stands.
struct State {
  Eigen::Vector4d quaternion;  // (w, x, y, z), of unit norm up to rounding
  Mat3 rotation;
  Triple turned;  // Q w_i
  Vec3 f;         // d_i . Q w_i - c_i
  double squared;  // |f|^2
};

/// Divided by the squared norm, so that the rounding of the quaternion does not reach the orthogonality of the matrix.
Mat3 rotation_of(const Eigen::Vector4d& quaternion) {
  const double w = quaternion[0], x = quaternion[1], y = quaternion[2], z = quaternion[3];
  Mat3 m;
  m << w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),  //
      2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x),   //
      2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return m / quaternion.squaredNorm();
}

State state(const RotationProblem& p, const Eigen::Vector4d& quaternion) {
  State s;
  s.quaternion = quaternion;
  s.rotation = rotation_of(quaternion);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto joint = static_cast<std::size_t>(i);
    s.turned[joint] = s.rotation * p.w[joint];
    s.f[i] = p.d[joint].dot(s.turned[joint]) - p.c[i];
  }
  s.squared = s.f.squaredNorm();
  return s;
}

/// The state turned on by the vector `step`, cut to the longest step. The quaternion (1, step / 2) is that rotation up to
/// the third order: Newton's method needs no more, and it takes no sine.
State moved(const RotationProblem& p, const State& s, const Vec3& step) {
  const double angle = step.norm();
  const Vec3 h = (angle > longest_step ? 0.5 * longest_step / angle : 0.5) * step;
  const Vec3 v = s.quaternion.tail<3>();
  Eigen::Vector4d q;
  q << s.quaternion[0] - h.dot(v), v + s.quaternion[0] * h + h.cross(v);
  return state(p, q.normalized());
}

double largest(const Vec3& f) {
  return f.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

/// Columns (Q w_i) x d_i: the transpose of J.
Mat3 gradients(const RotationProblem& p, const State& s) {
  Mat3 g;
  g << s.turned[0].cross(p.d[0]), s.turned[1].cross(p.d[1]), s.turned[2].cross(p.d[2]);
  return g;
}

/// -J^-1 f by Cramer's rule; not finite where J is singular.
Vec3 newton_step(const Mat3& g, const Vec3& f) {
  const Vec3 first = g.col(1).cross(g.col(2));
  return -(f[0] * first + f[1] * g.col(2).cross(g.col(0)) + f[2] * g.col(0).cross(g.col(1))) / g.col(0).dot(first);
}

/// -(J^T J + mu)^-1 J^T f: downhill, and the shorter the larger mu.
Vec3 levenberg_step(const Mat3& g, const Vec3& f, double mu) {
  return -(g * g.transpose() + mu * Mat3::Identity()).llt().solve(g * f);
}

/// Newton's step where it lowers |f| or, in a curved valley, |J^-1 f|; else the longest of Levenberg's that lowers |f|.
/// Nothing where none does.
std::optional<State> improved(const RotationProblem& p, const State& s) {
  const Mat3 g = gradients(p, s);
  const Vec3 newton = newton_step(g, s.f);
  if (newton.allFinite()) {
    const State next = moved(p, s, newton);
    if (next.squared < s.squared) return next;
    if (largest(s.f) <= settled) return {};
    if (newton_step(g, next.f).norm() < 0.75 * std::min(newton.norm(), longest_step)) return next;
  }
  for (double mu = 1e-3 * std::sqrt(s.squared); mu < 10.0; mu *= 10.0) {
    const State next = moved(p, s, levenberg_step(g, s.f, mu));
    if (next.squared < s.squared) return next;
  }
  return {};
}

}  // namespace

PolishedRotation polish_rotation(const RotationProblem& problem, const Mat3& start, int most_steps) {
  const Eigen::Quaterniond q(start);
  State s = state(problem, Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).normalized());
  State best = s;
  int stalled = 0;
  for (int step = 0; step < most_steps && largest(s.f) > rounding && stalled < patience; ++step) {
    const std::optional<State> next = improved(problem, s);
    if (!next) break;
    s = *next;
    stalled = s.squared < least_progress * best.squared ? 0 : stalled + 1;
    if (s.squared < best.squared) best = s;
  }
  PolishedRotation out;
  out.rotation = best.rotation;
  out.jacobian = gradients(problem, best).transpose();
  out.residual = largest(best.f);
  out.converged = out.residual <= acceptable;
  return out;
}

}  // namespace ninedof
