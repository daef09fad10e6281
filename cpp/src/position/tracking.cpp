#include "ninedof/position/tracking.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/numbers.hpp"
#include "ninedof/robot/legs.hpp"
#include "position/polish_rotation.hpp"
#include "position/rotation_problem.hpp"

namespace ninedof {
namespace {

constexpr double least_height = 1e-7;  // of O over a plane, relative to the longest leg: below it the side is unknown
constexpr double certified = 0.5;  // Kantorovich's theorem
constexpr double ball = 2.0 / (3.0 * std::numbers::sqrt3);  // of the separation: Newton converges from nearer starts
constexpr double shortest = 0x1p-18;  // step, as a fraction of the path
constexpr double aim = 0.4;  // desired certificate of a step; it grows with the length of the step
constexpr int most_attempts = 1000;
constexpr double angle_rounding = 1e-7;  // rad: half the digits, since the angle comes from a cosine
constexpr int uncertified_steps = 12;  // of Newton's method without a certificate

/// The robot, and the heights of O at the start, whose signs are the sides on which O stays.
struct Robot {
  const Geometry& geometry;
  const SphereCentres &base, &platform;
  double base_height, platform_height;
};

enum class Reach { yes, not_certified, infeasible };

/// One step from a rotation to new lengths.
struct Step {
  Reach reach = Reach::infeasible;
  Configuration configuration;
  double certificate = not_a_number, alone_within = not_a_number, separation = not_a_number;
};

/// Sets `point` to the position of O on the side of the start.
Meeting::Kind locate(const SphereCentres& plate, const Vec3& radii, double side, Vec3& point) {
  const Meeting m = meet(plate, radii);
  if (m.kind == Meeting::two_points) point = side < 0.0 ? plate.mirrored(m.above) : m.above;
  return m.kind;
}

Step step_to(const Robot& robot, const Vec9& lengths, const Mat3& rotation) {
  Step out;
  InternalPoints at;
  const Meeting::Kind lower = locate(robot.base, lengths.tail<3>(), robot.base_height, at.s),
                      upper = locate(robot.platform, lengths.segment<3>(3), robot.platform_height, at.o);
  if (lower == Meeting::none || upper == Meeting::none) return out;
  if (lower == Meeting::touching || upper == Meeting::touching) {
    out.reach = Reach::not_certified;  // a singularity: the mode can continue in two ways
    return out;
  }
  const ScaledRotationProblem p = rotation_problem(robot.geometry, at, lengths.head<3>());
  if ((p.unit.c.array().abs() > 1.0).any()) return out;
  out.reach = Reach::not_certified;
  if (!p.unit.c.allFinite()) return out;  // O on an external joint
  const RotationResidual seed(p.unit, rotation);
  const double beta = seed.inverse_norm();
  out.certificate = std::numbers::sqrt3 * beta * seed.newton_step().norm();
  const PolishedRotation polished =
      polish_rotation(p.unit, rotation, seed, out.certificate <= certified ? 60 : uncertified_steps);
  if (!polished.converged()) return out;
  out.separation = 1.0 / polished.at.inverse_norm();
  const double sine =
      (polished.rotation - rotation).norm() / (2.0 * std::numbers::sqrt2);  // of half the angle between them
  const double angle = 2.0 * std::asin(std::min(1.0, sine));
  if (out.certificate <= certified) {
    const double root = std::sqrt(1.0 - 2.0 * out.certificate), scale = std::numbers::sqrt3 * beta;
    if (!(angle <= (1.0 - root) / scale + angle_rounding)) return out;  // not the mode whose existence is proved
    out.alone_within = (1.0 + root) / scale;
  } else if (!(angle < ball * out.separation)) {
    return out;
  }
  out.reach = Reach::yes;
  out.configuration = {at.s - polished.rotation * at.o, polished.rotation, at.s};
  return out;
}

Tracked tracked(const Step& s, int steps) {
  return {TrackStatus::tracked, s.configuration, s.certificate, s.alone_within, s.separation, steps, 1.0};
}

Tracked lost(TrackStatus status, double reached, int steps) {
  Tracked out = Tracked::not_tried();
  out.status = status;
  out.reached = reached;
  out.steps = steps;
  return out;
}

}  // namespace

const char* to_string(TrackStatus status) {
  switch (status) {
    case TrackStatus::tracked: return "tracked";
    case TrackStatus::lost: return "lost";
    case TrackStatus::infeasible: return "infeasible";
  }
  return "";
}

Tracked Tracked::not_tried() {
  const Configuration nowhere{Vec3::Constant(not_a_number), Mat3::Constant(not_a_number), Vec3::Constant(not_a_number)};
  return {TrackStatus::lost, nowhere, not_a_number, not_a_number, not_a_number, 0, 0.0};
}

Tracker::Tracker(const Geometry& g) : geometry_(g), base_(g.base_internal()), platform_(g.platform_internal()) {}

Tracked Tracker::operator()(const Vec9& leg_lengths, const Configuration& start) const {
  require_leg_lengths(leg_lengths);
  const Vec3 o = start.rotation.transpose() * (start.internal_point - start.position);
  const Robot robot{geometry_, base_, platform_, base_.height(start.internal_point), platform_.height(o)};
  const double unit = leg_lengths.maxCoeff();
  if (!(std::min(std::abs(robot.base_height), std::abs(robot.platform_height)) > least_height * unit))
    return Tracked::not_tried();
  const Step whole = step_to(robot, leg_lengths, start.rotation);
  if (whole.reach == Reach::yes) return tracked(whole, 1);
  if (whole.reach == Reach::infeasible) return lost(TrackStatus::infeasible, 0.0, 0);

  const Vec9 from = ninedof::leg_lengths(geometry_, start);
  Mat3 rotation = start.rotation;
  double reached = 0.0, stride = 0.5;
  int steps = 0;
  for (int attempt = 0; attempt < most_attempts && stride >= shortest; ++attempt) {
    const double next = std::min(1.0, reached + stride);
    const Vec9 lengths = next < 1.0 ? Vec9(from + next * (leg_lengths - from)) : leg_lengths;
    const Step s = step_to(robot, lengths, rotation);
    const double adapted = (next - reached) * std::clamp(aim / s.certificate, 0.1, 4.0);
    if (s.reach != Reach::yes) {
      stride = s.reach == Reach::infeasible ? 0.5 * stride : std::min(0.7 * stride, adapted);
      continue;
    }
    ++steps;
    if (next == 1.0) return tracked(s, steps);
    reached = next;
    rotation = s.configuration.rotation;
    stride = adapted;
  }
  return lost(TrackStatus::lost, reached, steps);
}

Tracked track(const Geometry& g, const Vec9& leg_lengths, const Configuration& start) {
  return Tracker(g)(leg_lengths, start);
}

std::vector<Tracked> track(const Geometry& g, std::span<const Vec9> leg_lengths, const Configuration& start) {
  const Tracker step(g);
  std::vector<Tracked> out;
  out.reserve(leg_lengths.size());
  Configuration at = start;
  for (const Vec9& lengths : leg_lengths) {
    const bool stopped = !out.empty() && out.back().status != TrackStatus::tracked;
    out.push_back(stopped ? Tracked::not_tried() : step(lengths, at));
    at = out.back().configuration;
  }
  return out;
}

}  // namespace ninedof
