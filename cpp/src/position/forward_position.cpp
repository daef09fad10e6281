#include "ninedof/position/forward_position.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ninedof/position/trilateration.hpp"
#include "position/branch.hpp"
#include "position/length_unit.hpp"
#include "position/sharpen.hpp"

namespace ninedof {
namespace {

constexpr double planar = 1e-14;  // distance from a plane, relative to the triangle of joints, that is rounding

bool in_plane(const SphereCentres& plate, const Triple& joints) {
  return std::ranges::all_of(joints, [&](const Vec3& j) { return std::abs(plate.height(j)) <= planar * plate.length; });
}

/// A possible position of O and its side of the plane of internal joints.
struct SidedPoint {
  Vec3 point;
  int side;
};

struct SidedPoints {
  std::array<SidedPoint, 2> point;
  std::size_t count;
};

SidedPoints sided_points(const SphereCentres& plate, const Meeting& m) {
  if (m.kind == Meeting::touching) return {{{{m.above, 0}}}, 1};
  return {{{{m.above, 1}, {plate.mirrored(m.above), -1}}}, 2};
}

Mat3 mirror(const Vec3& normal) {
  return Mat3::Identity() - 2.0 * normal * normal.transpose();
}

void append(AssemblyModes& out, const SidedPoint& s, const SidedPoint& o, const Mat3& rotation, double separation) {
  const Configuration c{s.point - rotation * o.point, rotation, s.point};
  out.mode[at_index(out.count++)] = {c, s.side, o.side, separation};
}

/// The external leg that fits in no branch, or else all three together.
PositionObstacle external_obstacle(const std::array<bool, 3>& misfit) {
  for (std::size_t i = 0; i < 3; ++i)
    if (misfit[i])
      return static_cast<PositionObstacle>(static_cast<int>(PositionObstacle::external_leg_1) + static_cast<int>(i));
  return PositionObstacle::external_legs;
}

}  // namespace

const char* to_string(PositionStatus status) {
  switch (status) {
    case PositionStatus::found: return "found";
    case PositionStatus::tangent: return "tangent";
    case PositionStatus::infeasible: return "infeasible";
    case PositionStatus::self_motion: return "self_motion";
  }
  return "";
}

const char* to_string(PositionObstacle obstacle) {
  switch (obstacle) {
    case PositionObstacle::none: return "none";
    case PositionObstacle::lower_legs: return "lower_legs";
    case PositionObstacle::upper_legs: return "upper_legs";
    case PositionObstacle::external_leg_1: return "external_leg_1";
    case PositionObstacle::external_leg_2: return "external_leg_2";
    case PositionObstacle::external_leg_3: return "external_leg_3";
    case PositionObstacle::external_legs: return "external_legs";
  }
  return "";
}

namespace {

AssemblyModes solve_ordinary(const Geometry& g, const Vec9& leg_lengths, RotationMethod method) {
  const Vec3 l = leg_lengths.head<3>(), q = leg_lengths.segment<3>(3), r = leg_lengths.tail<3>();
  const double unit = leg_lengths.maxCoeff();
  AssemblyModes out;
  const SphereCentres base(g.base_internal()), platform(g.platform_internal());
  const Meeting lower = meet(base, r), upper = meet(platform, q);
  if (lower.kind == Meeting::none || upper.kind == Meeting::none) {
    out.obstacle = lower.kind == Meeting::none ? PositionObstacle::lower_legs : PositionObstacle::upper_legs;
    out.certain = (lower.kind == Meeting::none && lower.certain) || (upper.kind == Meeting::none && upper.certain);
    return out;
  }

  // If both bodies are planar, the mirror image of a mode in the base, the platform mirrored in itself, is a mode.
  const bool mirrored = in_plane(base, g.base_external()) && in_plane(platform, g.platform_external());
  const Mat3 base_mirror = mirror(base.e3), platform_mirror = mirror(platform.e3);
  const auto image = [](const SphereCentres& plate, const SidedPoint& p) -> SidedPoint {
    return p.side == 0 ? p : SidedPoint{plate.mirrored(p.point), -p.side};
  };
  const SidedPoints on_base = sided_points(base, lower), on_platform = sided_points(platform, upper);
  std::array<bool, 3> misfit{true, true, true};  // in every branch so far
  bool self_motion = false, double_mode = lower.kind == Meeting::touching || upper.kind == Meeting::touching;
  for (std::size_t i = 0; i < on_base.count; ++i)
    for (std::size_t j = 0; j < on_platform.count; ++j) {
      const SidedPoint &s = on_base.point[i], &o = on_platform.point[j];
      if (mirrored && (s.side < 0 || (s.side == 0 && o.side < 0))) continue;
      const Branch branch = solve_branch(g, {s.point, o.point}, l, {lower.error, upper.error, unit}, method);
      const bool has_image = mirrored && (s.side != 0 || o.side != 0);
      out.certain &= branch.certain;
      out.null_space_branches += branch.null_space ? 1 : 0;
      self_motion |= branch.self_motion;
      for (std::size_t leg = 0; leg < 3; ++leg) misfit[leg] &= branch.misfit[leg];
      for (int k = 0; k < branch.count; ++k) {
        const BranchMode& mode = branch.mode[at_index(k)];
        double_mode |= !mode.simple;
        append(out, s, o, mode.rotation, mode.separation);
        if (has_image)
          append(out, image(base, s), image(platform, o), base_mirror * mode.rotation * platform_mirror,
                 mode.separation);
      }
    }
  const double error = (lower.error + upper.error) / unit;
  for (std::size_t k = 0; k < at_index(out.count); ++k) {
    AssemblyMode& mode = out.mode[k];
    sharpen(g, leg_lengths, error, mode.configuration, mode.separation);
  }
  if (lower.kind == Meeting::touching || upper.kind == Meeting::touching) out.certain = false;  // one O or two
  if (self_motion) {
    out.status = PositionStatus::self_motion;
    out.count = 0;
    out.certain = false;
  } else if (out.count > 0) {
    out.status = double_mode ? PositionStatus::tangent : PositionStatus::found;
  } else {
    out.obstacle = external_obstacle(misfit);
  }
  return out;
}

}  // namespace

AssemblyModes forward_position(const Geometry& g, const Vec9& leg_lengths, RotationMethod method) {
  require_leg_lengths(leg_lengths);
  const int exponent = unit_exponent(std::max(largest_coordinate(g), leg_lengths.maxCoeff()));
  if (exponent == 0) return solve_ordinary(g, leg_lengths, method);
  const std::optional<Geometry> in_unit = scaled(g, -exponent);
  const Vec9 lengths = scaled(leg_lengths, -exponent);
  if (!in_unit || lengths.isZero(0.0)) {
    AssemblyModes out;
    out.obstacle = PositionObstacle::external_legs;
    out.certain = false;
    return out;
  }
  AssemblyModes out = solve_ordinary(*in_unit, lengths, method);
  for (int k = 0; k < out.count; ++k) {
    Configuration& c = out.mode[at_index(k)].configuration;
    c = scaled(c, exponent);
  }
  return out;
}

}  // namespace ninedof
