#pragma once
/// Rotation problems with a known solution, for the suites of the solver and of the polish.

#include <algorithm>
#include <vector>

#include "position/polish_rotation.hpp"
#include "position/rotation_problem.hpp"
#include "support/support.hpp"

namespace support {

using ninedof::RotationProblem;

inline Triple random_directions(Random& random) {
  return {random.unit(), random.unit(), random.unit()};
}

inline Triple turned(const Mat3& q, const Triple& t) {
  return {q * t[0], q * t[1], q * t[2]};
}

/// The problem that Q solves.
inline RotationProblem solved_by(const Mat3& q, const Triple& d, const Triple& w) {
  return {d, w, Vec3(d[0].dot(q * w[0]), d[1].dot(q * w[1]), d[2].dot(q * w[2]))};
}

inline double residual(const RotationProblem& p, const Mat3& q) {
  return (solved_by(q, p.d, p.w).c - p.c).cwiseAbs().maxCoeff();
}

/// The angle between two rotations, for small ones; no larger than it for any.
inline double apart(const Mat3& a, const Mat3& b) {
  return (a - b).norm() / std::sqrt(2.0);
}

/// A third platform direction with which the problem of Q has det J = 0: w_3 in the plane of d_3 and the normal of the
/// other two rows of J. `axis` is what J maps to zero.
inline Triple with_double_root(Random& random, const Mat3& q, const Triple& d, Triple w, Vec3& axis) {
  axis = (q * w[0]).cross(d[0]).cross((q * w[1]).cross(d[1])).normalized();
  w[2] = q.transpose() * (random.normal() * d[2] + random.normal() * axis).normalized();
  return w;
}

/// Polished candidates, those within 1e-7 rad of an earlier one left out.
inline std::vector<ninedof::PolishedRotation> solutions(const RotationProblem& p,
                                                        const ninedof::RotationCandidates& candidates) {
  std::vector<ninedof::PolishedRotation> out;
  for (std::size_t k = 0; k < static_cast<std::size_t>(candidates.count); ++k) {
    const auto polished = ninedof::polish_rotation(p, candidates.rotation[k]);
    bool left_out = !polished.converged();
    for (const auto& other : out) left_out = left_out || apart(other.rotation, polished.rotation) < 1e-7;
    if (!left_out) out.push_back(polished);
  }
  return out;
}
inline std::vector<ninedof::PolishedRotation> solutions(const RotationProblem& p) {
  return solutions(p, ninedof::null_space_rotations(p));
}

/// Distance from q to the nearest of the solutions.
inline double distance(const std::vector<ninedof::PolishedRotation>& found, const Mat3& q) {
  double least = infinity;
  for (const auto& s : found) least = std::min(least, apart(s.rotation, q));
  return least;
}

}  // namespace support
