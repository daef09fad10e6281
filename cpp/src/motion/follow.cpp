#include "ninedof/motion/follow.hpp"

#include <algorithm>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "ninedof/math/parallel.hpp"
#include "ninedof/position/tracking.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

constexpr double same = 1e-9;     // difference of a pose tracked back
constexpr long poses_a_task = 64;

void require_settings(const FollowSettings& settings, std::size_t poses) {
  const LegLimits& limits = settings.limits;
  for (int leg = 0; leg < 9; ++leg)
    if (!(0.0 <= limits.low[leg] && limits.low[leg] <= limits.high[leg]))
      throw InvalidArgument("limits", format_number(limits.low[leg]) + " to " + format_number(limits.high[leg]),
                            "0 <= low <= high");
  require_length("characteristic_length", settings.characteristic_length);
  if (settings.masses) validate(*settings.masses);
  if (!settings.loads.empty() && settings.loads.size() != poses)
    throw InvalidArgument("loads", std::to_string(settings.loads.size()), "none or " + std::to_string(poses));
}

/// Fills what depends on one pose and its derivatives.
void fill(const Geometry& g, std::span<const Configuration> path, const FollowSettings& settings, Followed& out,
          const Control& control) {
  const std::size_t n = path.size();
  for (auto* legs : {&out.leg_lengths, &out.leg_rates, &out.leg_accelerations}) legs->resize(n);
  out.condition_number.resize(n);
  out.singularity_margins.resize(n);
  const bool loaded = !settings.loads.empty();
  const Masses masses = settings.masses.value_or(Masses{});
  out.leg_forces.resize(loaded || settings.masses ? n : 0);
  parallel_for(static_cast<long>(n), poses_a_task, settings.threads, [&](long first, long last) {
    if (control.stop.stop_requested()) throw Stopped{};
    for (std::size_t k = at_index(first); k < at_index(last); ++k) {
      const Configuration& c = path[k];
      const Velocity& v = out.derivatives.velocity[k];
      out.leg_lengths[k] = leg_lengths(g, c);
      out.leg_rates[k] = inverse_velocity(g, c, v);
      out.leg_accelerations[k] = inverse_acceleration(g, c, v, out.derivatives.acceleration[k]);
      out.condition_number[k] = condition_number(g, c, settings.characteristic_length);
      out.singularity_margins[k] = singularity_margins(g, c);
      if (out.leg_forces.empty()) continue;
      const MotionState state{c, v, out.derivatives.acceleration[k]};
      const Load load = loaded ? settings.loads[k] : Load{};
      out.leg_forces[k] = inverse_dynamics(g, state, masses, settings.gravity, load).forces;
    }
  });
}

/// Tracks the lengths back to the poses.
void track_back(const Geometry& g, std::span<const Configuration> path, Followed& out, const Control& control) {
  const std::vector<Tracked> found = track(g, std::span(out.leg_lengths).subspan(1), path.front(), control.stop);
  double unit = 0.0;
  for (const Vec9& lengths : out.leg_lengths) unit = std::max(unit, lengths.maxCoeff());
  out.tracked = path.size();
  for (std::size_t k = 1; k < path.size(); ++k) {
    const bool reached = found[k - 1].status == TrackStatus::tracked;
    const Configuration &there = found[k - 1].configuration, &c = path[k];
    const double error = std::max({(there.position - c.position).cwiseAbs().maxCoeff() / unit,
                                   (there.rotation - c.rotation).cwiseAbs().maxCoeff(),
                                   (there.internal_point - c.internal_point).cwiseAbs().maxCoeff() / unit});
    if (reached) out.tracking_error = std::max(out.tracking_error, error);
    if (!(reached && error <= same)) out.tracked = std::min(out.tracked, k);
  }
}

}  // namespace

Followed follow(const Geometry& g, const Trajectory& trajectory, const Configuration& home,
                const FollowSettings& settings, const Control& control) {
  require_settings(settings, trajectory.poses.size());
  InternalPointProblem problem;
  problem.limits = settings.limits;
  problem.characteristic_length = settings.characteristic_length;
  Followed out;
  out.internal_point = internal_points(g, trajectory, home, settings.rule, problem, control);
  std::vector<Configuration> path;
  for (const PlatformPose& pose : trajectory.poses)
    path.push_back({pose.position, pose.rotation, out.internal_point[path.size()]});
  out.derivatives = path_derivatives(trajectory.time, path, control.stop);
  fill(g, path, settings, out, control);
  track_back(g, path, out, control);
  out.breaks = limit_breaks(trajectory.time, out.leg_lengths, settings.limits, out.singularity_margins);
  return out;
}

}  // namespace ninedof
