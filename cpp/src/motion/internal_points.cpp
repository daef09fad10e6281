#include "ninedof/motion/internal_points.hpp"

#include <algorithm>
#include <cmath>

#include "motion/cubic_spline.hpp"
#include "ninedof/math/error.hpp"
#include "robot/triangle.hpp"

namespace ninedof {
namespace {

using Kind = TrajectoryRule::Kind;

constexpr double smoothness = 0.1;  // of the best path

/// O at a pose, for each rule but `best`.
Vec3 placed(const Geometry& g, const PlatformPose& pose, const Configuration& home, const TrajectoryRule& rule) {
  const auto& [p, q] = pose;
  switch (rule.kind) {
    case Kind::held: return home.internal_point;
    case Kind::shifted: return p + (home.internal_point - home.position);
    case Kind::between: {
      const Vec3 below = centroid(g.base_internal()), above = p + q * centroid(g.platform_internal());
      return below + rule.fraction * (above - below);
    }
    default: return p + q * (home.rotation.transpose() * (home.internal_point - home.position));
  }
}

/// The poses at which the best O is searched, evenly chosen.
std::vector<std::size_t> picks(std::size_t n) {
  const std::size_t count = std::min(n, TrajectoryRule::most_searched);
  const double step = static_cast<double>(n - 1) / static_cast<double>(count - 1);
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < count; ++k)
    out.push_back(static_cast<std::size_t>(std::nearbyint(static_cast<double>(k) * step)));
  return out;
}

void require_allowed(const InternalPoint& point, double time) {
  if (!point.s.hasNaN()) return;
  std::string why;
  for (const std::string& name : point.active.names()) why += (why.empty() ? "" : ", ") + name;
  if (why.empty()) why = to_string(point.status);
  throw InvalidArgument("internal_point",
                        "'best', but no position of O is allowed at t = " + format_number(time) + " (" + why + ")",
                        "wider limits of the legs, or 'carried', 'shifted', 'held' or a fraction");
}

std::vector<Vec3> best(const Geometry& g, const Trajectory& trajectory, const Vec3& start,
                       const InternalPointProblem& problem, const Control& control) {
  const std::size_t n = trajectory.time.size();
  std::vector<double> time;
  std::vector<PlatformPose> poses;
  for (const std::size_t k : picks(n)) {
    time.push_back(trajectory.time[k]);
    poses.push_back(trajectory.poses[k]);
  }
  std::vector<Vec3> s;
  for (const InternalPoint& point : best_internal_path(g, poses, problem, smoothness, start, control)) {
    require_allowed(point, time[s.size()]);
    s.push_back(point.s);
  }
  if (s.size() == n) return s;
  std::vector<Vec3> out = cubic_spline(time, s, trajectory.time, is_closed(poses));
  out.front() = s.front();  // without rounding: a closed path closes to the last bit
  out.back() = s.back();
  return out;
}

}  // namespace

std::vector<Vec3> internal_points(const Geometry& g, const Trajectory& trajectory, const Configuration& home,
                                  const TrajectoryRule& rule, const InternalPointProblem& problem,
                                  const Control& control) {
  trajectory.validate();
  validate(home);
  require_finite("internal_point", rule.fraction);
  if (rule.kind == Kind::best)
    return best(g, trajectory, placed(g, trajectory.poses.front(), home, {}), problem, control);
  std::vector<Vec3> out;
  for (const PlatformPose& pose : trajectory.poses) out.push_back(placed(g, pose, home, rule));
  return out;
}

}  // namespace ninedof
