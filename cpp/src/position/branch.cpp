#include "position/branch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "math/numbers.hpp"
#include "position/polish_rotation.hpp"
#include "position/rotation_family.hpp"
#include "position/simple_mode.hpp"

namespace ninedof {
namespace {

// O counts as on an external joint within its own error, between these fractions of the largest length.
constexpr double least_void = 1e-13, largest_void = 1e-9;
constexpr double least_error = 1e-14;     // of the equations
constexpr double largest_error = 1e-6;    // of the equations: above it the number of modes is uncertain
constexpr double largest_basis_error = 1e-4;  // of the null-space method: above it real solutions may look complex
constexpr double safety = 100.0;          // error of the equations for which the null-space method confirms a mode
constexpr double between = 1e-14;         // residual halfway between two copies of a double solution
constexpr double double_rotation = 1e-4;  // rad: largest distance of two copies of a double solution
constexpr double same_rotation = 1e-7;    // rad
constexpr double cosine_rounding = 1e-7;  // rad: half the digits, since angles come from cosines

/// Adds candidates to a branch, polished and without duplicates.
class Collector {
 public:
  Collector(const RotationProblem& problem, double error) : problem_(problem), error_(error) {}

  /// Polishes a candidate and adds it if it converged to a new rotation.
  void add(const Mat3& candidate, Branch& out) const { add(polish_rotation(problem_, candidate), out); }
  void add(const PolishedRotation& polished, Branch& out) const {
    if (!polished.converged()) return;
    const double separation = 1.0 / polished.at.inverse_norm();
    for (int k = 0; k < out.count; ++k)
      if (same(out.mode[at_index(k)], polished.rotation)) return;
    if (out.count == static_cast<int>(out.mode.size())) return;
    out.mode[at_index(out.count++)] = {polished.rotation, separation,
                                       is_simple(problem_, polished, separation, error_)};
  }

 private:
  /// Whether a rotation is a copy of a mode. Copies of a simple mode are as far apart as the error of the equations
  /// allows. At a double solution they may be 1e-6 apart, but then the rotation halfway between them solves the
  /// equations as well.
  bool same(const BranchMode& mode, const Mat3& b) const {
    const Mat3& a = mode.rotation;
    const double squared = 0.5 * (a - b).squaredNorm();  // of the angle, where it is small
    if (squared < same_rotation * same_rotation) return true;
    if (mode.simple && squared * mode.separation * mode.separation < error_ * error_) return true;
    if (squared > double_rotation * double_rotation) return false;
    const Mat3 halfway = Eigen::Quaterniond(a).slerp(0.5, Eigen::Quaterniond(b)).toRotationMatrix();
    return RotationResidual(problem_, halfway).largest() <= between;
  }

  const RotationProblem& problem_;
  double error_;
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
std::optional<int> eliminate(const RotationProblem& problem, const Collector& collector, double error, Branch& out) {
  const RotationCandidates found = eliminated_rotations(problem, best_pivot(problem.c), error);
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

/// Bounds of the errors of the three equations, from those of O and from rounding: large if O is close to a joint.
Vec3 equation_errors(const ScaledRotationProblem& p, const Vec3& lengths, const BranchScale& scale) {
  const Vec3 &d = p.base_distance, &w = p.platform_distance;
  const Vec3 moved = (scale.s_error + scale.o_error + eps * (d + w + lengths).array()).matrix();
  return (4.0 * eps + (lengths + moved).array() * moved.array() / (d.array() * w.array())).matrix();
}

/// If O is on an external joint, the leg has no direction and its length does not depend on the rotation. The other
/// legs may be too long or too short. Returns whether this decides the branch: no mode, or a family of rotations.
bool settled_by_single_legs(ScaledRotationProblem& p, const Vec3& lengths, const BranchScale& scale, const Vec3& error,
                            Branch& out) {
  const double within = largest_void * scale.unit, errors = scale.s_error + scale.o_error;
  const double on_base = std::clamp(scale.s_error, least_void * scale.unit, within);
  const double on_platform = std::clamp(scale.o_error, least_void * scale.unit, within);
  std::array<bool, 3> is_void{};
  bool any_void = false, any_misfit = false, undecided = errors > unknown_point * scale.unit;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double d = p.base_distance[k], w = p.platform_distance[k];
    double& c = p.unit.c[k];
    is_void[i] = d < on_base || w < on_platform;
    any_void |= is_void[i];
    if (is_void[i]) {
      const double difference = std::abs(std::max(d, w) - lengths[k]);
      out.misfit[i] = !(difference <= 2.0 * within + errors);
      undecided |= difference > 2.0 * within;
      out.certain &= std::isfinite(d + w);
    } else {
      out.misfit[i] = !(std::abs(c) <= 1.0 + std::max(cosine_slack, error[k]));
      out.certain &= std::isfinite(c) && (out.misfit[i] || std::abs(c) <= 1.0);
      if (!out.misfit[i]) c = std::clamp(c, -1.0, 1.0);
    }
    any_misfit |= out.misfit[i];
  }
  if (any_misfit || !any_void) return any_misfit;
  out.self_motion = !undecided;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (is_void[i] && !is_void[j] && !is_void[k]) out.self_motion &= two_legs_fit(p.unit, j, k);
  }
  out.certain &= !out.self_motion && !undecided;
  return true;
}

/// Where the null-space method sees a family of solutions, possibly complex, possibly with isolated ones beside it, or
/// cannot tell one from nearly equal equations. A real family is found from start values all around.
void search_from_everywhere(const RotationProblem& problem, const Collector& collector, double error, Branch& out) {
  RotationFamily family(problem, error);
  for (const Mat3& start : cube_rotations()) {
    const PolishedRotation polished = polish_rotation(problem, start);
    collector.add(polished, out);
    family.add(polished);
  }
  family.follow();
  out.self_motion = family.proved();
  if (out.self_motion) out.count = 0;
  out.certain = false;
}

bool all_simple(const RotationProblem& problem, const Branch& found, double error) {
  for (int k = 0; k < found.count; ++k) {
    const BranchMode& mode = found.mode[at_index(k)];
    if (!is_simple(problem, {mode.rotation, {problem, mode.rotation}}, mode.separation, error)) return false;
  }
  return true;
}

}  // namespace

Branch solve_branch(const Geometry& g, const InternalPoints& at, const Vec3& external_lengths, const BranchScale& scale,
                    RotationMethod method) {
  Branch out;
  ScaledRotationProblem p = rotation_problem(g, at, external_lengths);
  const Vec3 errors = equation_errors(p, external_lengths, scale);
  if (settled_by_single_legs(p, external_lengths, scale, errors, out)) return out;
  const double error = std::max(least_error, errors.maxCoeff());
  const bool accurate = out.certain && error <= largest_error;
  const Collector collector(p.unit, error);
  std::optional<int> expected;
  if (method != RotationMethod::null_space) {
    expected = eliminate(p.unit, collector, error, out);
    const bool complete = expected == out.count;
    out.certain = complete && accurate;
    for (int k = 0; k < out.count; ++k) out.certain &= out.mode[at_index(k)].simple;
    if (complete || method == RotationMethod::elimination) return out;
  }
  out.null_space = true;
  const RotationCandidates found = null_space_rotations(p.unit);
  if (found.self_motion) {
    search_from_everywhere(p.unit, collector, error, out);
    return out;
  }
  // Modes found by elimination are kept: they solve the equations. The number is confirmed if every nearly real
  // solution has become a separate mode, and elimination, if reliable, found the same number.
  for (int k = 0; k < found.count; ++k) collector.add(found.rotation[at_index(k)], out);
  out.certain = accurate && found.reliable && found.sensitivity * error <= largest_basis_error && out.count % 2 == 0 &&
                out.count >= found.count && expected.value_or(out.count) == out.count &&
                all_simple(p.unit, out, safety * error);
  return out;
}

}  // namespace ninedof
