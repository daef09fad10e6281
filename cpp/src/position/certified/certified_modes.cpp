#include "ninedof/position/certified_modes.hpp"

#include <cmath>
#include <optional>

#include "ninedof/math/rotation.hpp"
#include "ninedof/position/forward_position.hpp"
#include "position/certified/rotation_search.hpp"
#include "position/polish_rotation.hpp"

namespace ninedof {
namespace {

/// O in both frames, on given sides of the planes of internal joints.
struct BranchBounds {
  const SidedPointBounds& s;
  const SidedPointBounds& o;
  double unit;

  bool one_point() const { return s.side != 0 && o.side != 0; }
};

using MatrixBounds = std::array<PointBounds, 3>;  // rows

MatrixBounds rotation_bounds(const QuaternionBounds& z) {
  const auto& [w, x, y, t] = z;
  const Interval two = 2.0, ww = square(w), xx = square(x), yy = square(y), tt = square(t);
  const Interval inverse = Interval(1.0) / (ww + xx + yy + tt);
  return {inverse * PointBounds{ww + xx - yy - tt, two * (x * y - w * t), two * (x * t + w * y)},
          inverse * PointBounds{two * (x * y + w * t), ww - xx + yy - tt, two * (y * t - w * x)},
          inverse * PointBounds{two * (x * t - w * y), two * (y * t + w * x), ww - xx - yy + tt}};
}

double farthest_entry(const PointBounds& v) {
  return std::max({magnitude(v.x), magnitude(v.y), magnitude(v.z)});
}

/// The largest error of a configuration that stands for all of a box: of Q, and of p and O as a fraction of the unit.
double error_of(const Configuration& c, const QuaternionBounds& z, const BranchBounds& at) {
  const MatrixBounds q = rotation_bounds(z);
  const PointBounds turned{dot(q[0], at.o.point), dot(q[1], at.o.point), dot(q[2], at.o.point)};
  const double p = farthest_entry(at.s.point - turned - bounds_of(c.position));
  const double s = farthest_entry(at.s.point - bounds_of(c.internal_point));
  double out = detail::above(std::max(p, s) / at.unit);
  for (Eigen::Index i = 0; i < 3; ++i)
    out = std::max(out, farthest_entry(q[at_index(i)] - bounds_of(c.rotation.row(i))));
  return out;
}

Vec3 middle_of(const PointBounds& v) {
  return {middle(v.x), middle(v.y), middle(v.z)};
}

Configuration middle_of(const QuaternionBounds& z, const BranchBounds& at) {
  const Mat3 q = rotation_from_quaternion({middle(z[0]), middle(z[1]), middle(z[2]), middle(z[3])});
  const Vec3 s = middle_of(at.s.point);
  return {s - q * middle_of(at.o.point), q, s};
}

void add_undecided(CertifiedModes& out, const QuaternionBounds& z, const BranchBounds& at) {
  const Configuration c = middle_of(z, at);
  out.undecided.push_back({c, error_of(c, z, at), at.s.side, at.o.side});
}

/// The modes listed for a branch.
struct Listed {
  std::vector<std::size_t> number;
  std::vector<Eigen::Vector4d> quaternion;
};

Listed listed_in(const AssemblyModes& modes, int count, const BranchBounds& at) {
  Listed out;
  for (std::size_t k = 0; k < at_index(count); ++k) {
    const AssemblyMode& mode = modes.mode[k];
    if (mode.base_side != at.s.side || mode.platform_side != at.o.side) continue;
    out.number.push_back(k);
    out.quaternion.push_back(quaternion_from_rotation(mode.configuration.rotation));
  }
  return out;
}

/// Gives its radius to a mode in the list; one that is missing there is added.
void add_proved(CertifiedModes& out, const QuaternionBounds& z, const BranchBounds& at,
                std::optional<std::size_t> number, const Geometry& g, const Vec3& external_lengths) {
  ++out.proved;
  AssemblyModes& modes = out.modes;
  if (!number) {
    if (at_index(modes.count) == modes.mode.size()) return;
    number = at_index(modes.count++);
    const Configuration c = middle_of(z, at);
    const ScaledRotationProblem problem =
        rotation_problem(g, {c.internal_point, middle_of(at.o.point)}, external_lengths);
    const double separation = 1.0 / RotationResidual(problem.unit, c.rotation).inverse_norm();
    modes.mode[*number] = {c, at.s.side, at.o.side, separation};
  }
  out.radius[*number] = error_of(modes.mode[*number].configuration, z, at);
}

/// Makes list and status agree with what is proved. Once all is, the list holds the proved modes alone.
void settle(CertifiedModes& out, PositionObstacle obstacle) {
  AssemblyModes& modes = out.modes;
  if (!out.complete()) {
    if (modes.status == PositionStatus::self_motion) modes.count = 0;
    if (modes.status == PositionStatus::infeasible && modes.count > 0) modes.status = PositionStatus::found;
  } else {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < at_index(modes.count); ++k) {
      if (!std::isfinite(out.radius[k])) continue;
      modes.mode[kept] = modes.mode[k];
      out.radius[kept++] = out.radius[k];
    }
    modes.count = static_cast<int>(kept);
    modes.certain = true;
    modes.status = kept > 0 ? PositionStatus::found : PositionStatus::infeasible;
    if (modes.obstacle == PositionObstacle::none) modes.obstacle = obstacle;
  }
  if (modes.status != PositionStatus::infeasible) modes.obstacle = PositionObstacle::none;
}

}  // namespace

CertifiedModes certified_modes(const Geometry& g, const Vec9& leg_lengths) {
  require_sound_arithmetic();
  CertifiedModes out;
  out.modes = forward_position(g, leg_lengths);
  out.radius.fill(detail::no_bound);
  const int listed_count = out.modes.count;
  const Vec3 external = leg_lengths.head<3>();
  const auto base = meeting_bounds(g.base_internal(), leg_lengths.tail<3>());
  const auto platform = meeting_bounds(g.platform_internal(), leg_lengths.segment<3>(3));
  for (const SidedPointBounds& s : base)
    for (const SidedPointBounds& o : platform) {
      const BranchBounds at{s, o, leg_lengths.maxCoeff()};
      const RotationQuadrics quadrics(g, s.point, o.point, external);
      if (quadrics.impossible()) continue;
      if (!quadrics.known()) {
        add_undecided(out, {1.0, Interval::whole(), Interval::whole(), Interval::whole()}, at);
        continue;
      }
      const Listed listed = listed_in(out.modes, listed_count, at);
      const ProvedRotations found = proved_rotations(quadrics, listed.quaternion);
      out.boxes += found.boxes;
      for (const ChartBox& box : found.undecided) add_undecided(out, box.z, at);
      for (const ProvedRotation& rotation : found.proved) {
        const QuaternionBounds& z = rotation.enclosure.z;
        const bool is_listed = rotation.guess < listed.number.size();
        if (at.one_point())
          add_proved(out, z, at, is_listed ? std::optional(listed.number[rotation.guess]) : std::nullopt, g, external);
        else add_undecided(out, z, at);
      }
    }
  settle(out, base.empty()       ? PositionObstacle::lower_legs
              : platform.empty() ? PositionObstacle::upper_legs
                                 : PositionObstacle::external_legs);
  return out;
}

}  // namespace ninedof
