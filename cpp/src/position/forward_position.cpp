#include "ninedof/position/forward_position.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ninedof/math/error.hpp"
#include "ninedof/position/trilateration.hpp"
#include "position/branch.hpp"

namespace ninedof {
namespace {

constexpr double planar = 1e-14;  // distance from a plane, relative to the triangle of joints, that is rounding
constexpr double ordinary = 0x1p100;  // between 2^-100 and 2^100 no product of up to five lengths overflows

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

double largest_coordinate(const Geometry& g) {
  const auto largest = [](const Triple& t) { return Eigen::Map<const Vec9>(t[0].data()).lpNorm<Eigen::Infinity>(); };
  return std::max({largest(g.base_external()), largest(g.base_internal()), largest(g.platform_external()),
                   largest(g.platform_internal())});
}

/// The joints times a power of two; none if a plate is lost by underflow.
std::optional<Geometry> scaled(const Geometry& g, int exponent) {
  const auto times = [&](Triple t) {
    for (Vec3& joint : t)
      for (double& x : joint) x = std::ldexp(x, exponent);
    return t;
  };
  try {
    return Geometry(times(g.base_external()), times(g.base_internal()), times(g.platform_external()),
                    times(g.platform_internal()));
  } catch (const InvalidArgument&) {
    return {};
  }
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

/// In a unit that makes the largest number about 1. A power of two changes no digits.
AssemblyModes solve_scaled(const Geometry& g, const Vec9& leg_lengths, int exponent, RotationMethod method) {
  AssemblyModes out;
  const std::optional<Geometry> unit = scaled(g, -exponent);
  Vec9 lengths = leg_lengths;
  for (double& length : lengths) length = std::ldexp(length, -exponent);
  if (!unit || lengths.isZero(0.0)) {
    out.obstacle = PositionObstacle::external_legs;
    out.certain = false;
    return out;
  }
  out = solve_ordinary(*unit, lengths, method);
  for (int k = 0; k < out.count; ++k) {
    Configuration& c = out.mode[at_index(k)].configuration;
    for (Vec3* point : {&c.position, &c.internal_point})
      for (double& x : *point) x = std::ldexp(x, exponent);
  }
  return out;
}

}  // namespace

AssemblyModes forward_position(const Geometry& g, const Vec9& leg_lengths, RotationMethod method) {
  require_leg_lengths(leg_lengths);
  const double largest = std::max(largest_coordinate(g), leg_lengths.maxCoeff());
  if (largest < ordinary && largest > 1.0 / ordinary) return solve_ordinary(g, leg_lengths, method);
  return solve_scaled(g, leg_lengths, std::ilogb(largest), method);
}

}  // namespace ninedof
