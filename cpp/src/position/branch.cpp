#include "position/branch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "position/polish_rotation.hpp"

namespace ninedof {
namespace {

constexpr double void_leg = 1e-9;         // of the largest length: O this close to an external joint counts as on it
constexpr double between = 1e-14;         // residual halfway between two copies of a double solution
constexpr double double_rotation = 1e-4;  // rad: largest distance of two copies of a double solution
constexpr double same_rotation = 1e-7;    // rad
constexpr double cosine_rounding = 1e-7;  // rad: half the digits, since angles come from cosines
constexpr double double_solution = 1e-6;  // separation below which the number of modes is uncertain

/// Adds candidates to a branch, polished and without duplicates.
class Collector {
 public:
  explicit Collector(const RotationProblem& problem) : problem_(problem) {}

  /// Returns whether the candidate converged to a new rotation.
  bool add(const Mat3& candidate, Branch& out) const {
    const PolishedRotation polished = polish_rotation(problem_, candidate);
    if (!polished.converged()) return false;
    for (int k = 0; k < out.count; ++k)
      if (same(out.mode[at_index(k)].rotation, polished.rotation)) return false;
    if (out.count == static_cast<int>(out.mode.size())) return false;
    out.mode[at_index(out.count++)] = {polished.rotation, 1.0 / polished.at.inverse_norm()};
    return true;
  }

 private:
  /// Whether two rotations are copies of one mode. At a double solution they may be 1e-6 apart, but then the rotation
  /// halfway between them solves the equations as well.
  bool same(const Mat3& a, const Mat3& b) const {
    const double squared = 0.5 * (a - b).squaredNorm();  // of the angle, where it is small
    if (squared < same_rotation * same_rotation) return true;
    if (squared > double_rotation * double_rotation) return false;
    const Mat3 halfway = Eigen::Quaterniond(a).slerp(0.5, Eigen::Quaterniond(b)).toRotationMatrix();
    return RotationResidual(problem_, halfway).largest() <= between;
  }

  const RotationProblem& problem_;
};

/// The 24 rotations of a cube: every rotation is within about one radian of one of them.
std::array<Mat3, 24> cube_rotations() {
  std::array<Mat3, 24> out;
  std::size_t count = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (const double a : {1.0, -1.0})
        for (const double b : {1.0, -1.0})
          if (i != j) {
            const Vec3 x = a * Vec3::Unit(i), y = b * Vec3::Unit(j);
            out[count++] << x, y, x.cross(y);
          }
  return out;
}

/// The leg with the smallest |c_i|: the axes of its two frames are closest to perpendicular.
int best_pivot(const Vec3& c) {
  Eigen::Index k;
  c.cwiseAbs().minCoeff(&k);
  return static_cast<int>(k);
}

/// Adds the modes found by elimination and returns their expected number, if elimination is reliable.
std::optional<int> eliminate(const RotationProblem& problem, const Collector& collector, Branch& out) {
  const RotationCandidates found = eliminated_rotations(problem, best_pivot(problem.c));
  for (int k = 0; k < found.count; ++k) collector.add(found.rotation[at_index(k)], out);
  return found.reliable ? std::optional(found.count) : std::nullopt;
}

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Least angle between points of two circles of angular radii a and b on the unit sphere, their centres `apart`.
double least_angle(double apart, double a, double b) {
  return std::max({0.0, apart - a - b, std::abs(a - b) - apart, apart + a + b - 2.0 * std::numbers::pi});
}

/// Whether some Q fits legs i and j. If the third leg has no direction, it decides between self-motion and no mode.
bool two_legs_fit(const RotationProblem& problem, std::size_t i, std::size_t j) {
  // Q w_i lies on a circle about d_i and Q w_j on one about d_j, with the angle of w_i and w_j between them. All angles
  // occur from the least to the largest, which is pi minus the least to the opposite circle.
  constexpr double pi = std::numbers::pi;
  const double a = std::acos(std::clamp(problem.c[static_cast<Eigen::Index>(i)], -1.0, 1.0));
  const double b = std::acos(std::clamp(problem.c[static_cast<Eigen::Index>(j)], -1.0, 1.0));
  const double base = angle(problem.d[i], problem.d[j]), platform = angle(problem.w[i], problem.w[j]);
  return platform >= least_angle(base, a, b) - cosine_rounding &&
         platform <= pi - least_angle(pi - base, a, b) + cosine_rounding;
}

/// If O is on an external joint, the leg has no direction and its length does not depend on the rotation. The other
/// legs may be too long or too short. Returns whether this decides the branch: no mode, or a family of rotations.
bool settled_by_single_legs(const ScaledRotationProblem& p, const Vec3& lengths, double unit, Branch& out) {
  std::array<bool, 3> is_void{};
  bool any_void = false, any_misfit = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    is_void[i] = std::min(p.base_distance[k], p.platform_distance[k]) < void_leg * unit;
    const double length = std::max(p.base_distance[k], p.platform_distance[k]);
    out.misfit[i] =
        is_void[i] ? std::abs(length - lengths[k]) > 2.0 * void_leg * unit : !(std::abs(p.unit.c[k]) <= 1.0);
    any_void |= is_void[i];
    any_misfit |= out.misfit[i];
  }
  if (any_misfit || !any_void) return any_misfit;
  out.self_motion = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (is_void[i] && !is_void[j] && !is_void[k]) out.self_motion = two_legs_fit(p.unit, j, k);
  }
  return true;
}

}  // namespace

Branch solve_branch(const Geometry& g, const InternalPoints& at, const Vec3& external_lengths, double unit,
                    RotationMethod method) {
  Branch out;
  const ScaledRotationProblem p = rotation_problem(g, at, external_lengths);
  if (settled_by_single_legs(p, external_lengths, unit, out)) return out;
  const Collector collector(p.unit);
  std::optional<int> expected;
  if (method != RotationMethod::null_space) {
    expected = eliminate(p.unit, collector, out);
    out.certain = expected == out.count;
    if (out.certain || method == RotationMethod::elimination) return out;
  }
  out.null_space = true;
  const RotationCandidates found = null_space_rotations(p.unit);
  if (found.self_motion) {
    // A family of solutions, possibly complex, possibly with isolated ones beside it. A real family is found from start
    // values all around, and its members are singular.
    for (const Mat3& start : cube_rotations()) collector.add(start, out);
    for (int k = 0; k < out.count; ++k) out.self_motion |= !(out.mode[at_index(k)].separation > double_solution);
    if (out.self_motion) out.count = 0;
    out.certain = false;
    return out;
  }
  // Modes found by elimination are kept: they solve the equations. The number is confirmed if every nearly real
  // solution has become a separate mode, and elimination, if reliable, found the same number.
  for (int k = 0; k < found.count; ++k) collector.add(found.rotation[at_index(k)], out);
  out.certain =
      found.reliable && out.count % 2 == 0 && out.count >= found.count && expected.value_or(out.count) == out.count;
  for (int k = 0; k < out.count; ++k) out.certain &= out.mode[at_index(k)].separation > double_solution;
  return out;
}

}  // namespace ninedof
