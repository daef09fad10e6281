#include "ninedof/position/tracking.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "math/numbers.hpp"
#include "ninedof/math/control.hpp"
#include "ninedof/robot/legs.hpp"
#include "position/length_unit.hpp"
#include "position/path_bounds.hpp"
#include "position/polish_rotation.hpp"
#include "position/rotation_problem.hpp"
#include "position/sharpen.hpp"

namespace ninedof {
namespace {

constexpr double least_height = 1e-7;  // of O over a plane, relative to the longest leg: below it the side is unknown
constexpr double certified = 0.5;  // Kantorovich's theorem
constexpr double proved = 0.499;  // the same for bounds, with room for their rounding
constexpr double ball = 2.0 / (3.0 * std::numbers::sqrt3);  // of the separation: Newton converges from nearer starts
constexpr double hopeless = 2.0;  // certificate above which a step is not tried
constexpr int uncertified_steps = 12;  // of Newton's method where it is not proved to converge
constexpr int most_halvings = 5;  // of the lengths of a step, for its proof
constexpr double shortest = 0x1p-44;  // step, as a fraction of the path: next to a singularity little above rounding
constexpr double aim = 0.4;  // desired certificate of a step; it grows with the length of the step
constexpr int most_attempts = 20'000;
constexpr double known_to = 1e-13;  // residual of a mode that is known
constexpr double touches_plane = 1e-6;  // height of O relative to the longest leg: below it rounding hides the plane
constexpr double merged = 8.0;  // separation in roots of the error of the equations: below it rounding hides a fold

/// The robot, and three numbers of the start that no step lets change their sign: the heights of O over the two plates,
/// which are det B and det C but for positive factors, and such a multiple of det N.
struct Robot {
  const Geometry& geometry;
  const SphereCentres &base, &platform;
  double base_height, platform_height, det_n;
};

/// A point of the path. The residuals (l^2 - |r - s - Q (u - o)|^2) / 2 of the external legs are those of the rotation
/// from which the step starts: zero at its start.
struct Waypoint {
  Waypoint(const Robot& robot, const Vec9& all, const InternalPoints& at, const Vec3& of_legs)
      : lengths(all),
        lower(robot.base, at.s, all.tail<3>()),
        upper(robot.platform, at.o, all.segment<3>(3)),
        residual(of_legs) {}

  Vec9 lengths;
  PlatePoint lower, upper;
  Vec3 residual;
};

/// A later point of the path, and Kantorovich's number of its equations at the rotation from which the step starts.
struct Target {
  Target(const Robot& robot, const Vec9& lengths, const InternalPoints& there, const ScaledRotationProblem& problem,
         const Mat3& rotation, double point_error)
      : at(there),
        scaled(problem),
        seed(problem.unit, rotation),
        scale(problem.base_distance.cwiseProduct(problem.platform_distance)),
        waypoint(robot, lengths, there, seed.value.cwiseProduct(scale)),
        of_points(point_error / lengths.maxCoeff()),
        error(known_to + point_error * lengths.head<3>().maxCoeff() / scale.minCoeff()),
        beta(seed.inverse_norm()),
        eta(seed.newton_step().norm()) {}

  double certificate() const { return std::numbers::sqrt3 * beta * eta; }

  InternalPoints at;
  ScaledRotationProblem scaled;
  RotationResidual seed;
  Vec3 scale;  ///< of the residuals
  Waypoint waypoint;
  double of_points;  ///< error of O in both frames, relative to the longest leg
  double error;  ///< of the equations, from rounding and from that of O
  double beta, eta;
};

enum class Reach { yes, not_certified, infeasible };

/// One step from a configuration to new lengths.
struct Step {
  Reach reach = Reach::infeasible;
  Configuration configuration;
  double certificate = not_a_number, alone_within = not_a_number, separation = not_a_number;
};

/// Sets `point` to the position of O on the side of the start.
Meeting locate(const SphereCentres& plate, const Vec3& radii, double side, Vec3& point) {
  const Meeting m = meet(plate, radii);
  if (m.kind == Meeting::two_points) point = side < 0.0 ? plate.mirrored(m.above) : m.above;
  return m;
}

Reach set_target(const Robot& robot, const Vec9& lengths, const Mat3& rotation, std::optional<Target>& out) {
  InternalPoints at;
  const Meeting lower = locate(robot.base, lengths.tail<3>(), robot.base_height, at.s),
                upper = locate(robot.platform, lengths.segment<3>(3), robot.platform_height, at.o);
  if (lower.kind == Meeting::none || upper.kind == Meeting::none) return Reach::infeasible;
  // A singularity: the mode can continue in two ways.
  if (lower.kind == Meeting::touching || upper.kind == Meeting::touching) return Reach::not_certified;
  // Nearly one: a plate so much smaller than its legs that they hardly place O.
  const double error = lower.error + upper.error;
  if (!(error <= unknown_point * lengths.maxCoeff())) return Reach::not_certified;
  const ScaledRotationProblem p = rotation_problem(robot.geometry, at, lengths.head<3>());
  if ((p.unit.c.array().abs() > 1.0).any()) return Reach::infeasible;
  if (!p.unit.c.allFinite()) return Reach::not_certified;  // O on an external joint
  out.emplace(robot, lengths, at, p, rotation, error);
  return Reach::yes;
}

/// Whether, for all lengths between two points of the path, Kantorovich's number stays below 1/2 and a mode within
/// `away` is the only one there, by bounds of the derivatives of the equations along the path
/// (docs/theory/position.md).
bool bounded(const Robot& robot, const Waypoint& from, const Target& to, double away) {
  const PathBounds lower = path_bounds(robot.base, from.lower, to.waypoint.lower),
                   upper = path_bounds(robot.platform, from.upper, to.waypoint.upper);
  const double speed = lower.speed + upper.speed, acceleration = lower.acceleration + upper.acceleration;
  double lipschitz2 = 0.0, change2 = 0.0, bend2 = 0.0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double stretch =
        (1.0 + lower.speed / to.scaled.base_distance[k]) * (1.0 + upper.speed / to.scaled.platform_distance[k]);
    lipschitz2 += stretch * stretch;
    change2 += (stretch - 1.0) * (stretch - 1.0);
    const double l = to.waypoint.lengths[k], rate = l - from.lengths[k];
    const double distance = std::sqrt(std::max(0.0, l * l - 2.0 * to.waypoint.residual[k])) + speed;
    const double bend = (std::max(rate * rate, speed * speed) + distance * acceleration) / (8.0 * to.scale[k]);
    bend2 += bend * bend;
  }
  const double kept = 1.0 - to.beta * std::sqrt(change2);
  if (!(kept > 0.0)) return false;
  const double start = to.seed.newton_step(from.residual.cwiseQuotient(to.scale)).norm();
  const double eta = std::max(start, to.eta) + to.beta * (std::sqrt(bend2) + to.error);
  const double scale = std::sqrt(lipschitz2) * to.beta / kept;
  return scale * eta / kept <= proved && scale * away <= 1.0;
}

/// The same with points between where the bounds are too wide.
bool proved_between(const Robot& robot, const Waypoint& from, const Target& to, const Mat3& rotation, double away,
                    int halvings = most_halvings) {
  if (bounded(robot, from, to, away)) return true;
  if (halvings == 0) return false;
  std::optional<Target> middle;
  if (set_target(robot, 0.5 * (from.lengths + to.waypoint.lengths), rotation, middle) != Reach::yes) return false;
  return middle->certificate() <= certified && proved_between(robot, from, *middle, rotation, away, halvings - 1) &&
         proved_between(robot, middle->waypoint, to, rotation, away, halvings - 1);
}

double angle_between(const Mat3& a, const Mat3& b) {
  return 2.0 * std::asin(std::min(1.0, (a - b).norm() / (2.0 * std::numbers::sqrt2)));
}

/// Half-way between two rotations less than a half-turn apart.
Mat3 middle_rotation(const Mat3& a, const Mat3& b) {
  const Eigen::Quaterniond from(a), to(b);
  return from.slerp(0.5, to).normalized().toRotationMatrix();
}

/// The same proof from the rotation half-way between those of start and end, where the residuals are half as large: the
/// only mode near it is the start's at the start, and the one reached at the end.
bool proved_from_middle(const Robot& robot, const Vec9& from, const Vec9& to, const Mat3& start, const Mat3& end) {
  const Mat3 middle = middle_rotation(start, end);
  const double away = 0.5 * angle_between(start, end);
  std::optional<Target> first, last;
  return set_target(robot, from, middle, first) == Reach::yes && set_target(robot, to, middle, last) == Reach::yes &&
         proved_between(robot, first->waypoint, *last, middle, away);
}

Step step_to(const Robot& robot, const Waypoint& start, const Vec9& lengths, const Mat3& rotation) {
  Step out;
  std::optional<Target> target;
  out.reach = set_target(robot, lengths, rotation, target);
  if (out.reach != Reach::yes) return out;
  out.reach = Reach::not_certified;
  out.certificate = target->certificate();
  if (!(out.certificate <= hopeless)) return out;
  const bool forward = out.certificate <= certified && proved_between(robot, start, *target, rotation, 0.0);
  const PolishedRotation polished =
      polish_rotation(target->scaled.unit, rotation, target->seed, forward ? 60 : uncertified_steps);
  // Where a proof holds det N keeps its sign. Compared all the same.
  if (!polished.converged() || !(polished.at.determinant * robot.det_n > 0.0)) return out;
  out.separation = 1.0 / polished.at.inverse_norm();
  const double root = std::sqrt(1.0 - 2.0 * out.certificate), scale = std::numbers::sqrt3 * target->beta;
  if (out.certificate <= certified) out.alone_within = (1.0 + root) / scale;
  const double angle = angle_between(polished.rotation, rotation);
  // The mode whose existence near the start is proved lies within the first radius of Kantorovich's theorem.
  const double angle_error = known_to / out.separation + 8.0 * eps;
  if (forward && !(angle <= (1.0 - root) / scale + angle_error)) return out;
  if (!forward) {
    if (out.certificate > certified && !(angle < ball * out.separation)) return out;
    if (!proved_from_middle(robot, start.lengths, lengths, rotation, polished.rotation)) return out;
  }
  out.reach = Reach::yes;
  out.configuration = {target->at.s - polished.rotation * target->at.o, polished.rotation, target->at.s};
  sharpen(robot.geometry, lengths, target->of_points, out.configuration, out.separation);
  return out;
}

/// Whether the mode ends here as far as rounding tells: O in a plane of internal joints, or two modes that are one.
bool ends_at(const Robot& robot, const Waypoint& at, const Mat3& rotation) {
  const double least = std::min(std::abs(at.lower.height), std::abs(at.upper.height));
  if (least <= touches_plane * at.lengths.maxCoeff()) return true;
  std::optional<Target> here;
  if (set_target(robot, at.lengths, rotation, here) != Reach::yes) return false;
  return here->beta * merged * std::sqrt(here->error) >= 1.0;
}

/// Of the unit of the robot; 0 where a plate would be lost in it.
int usable_exponent(const Geometry& g) {
  const int exponent = unit_exponent(largest_coordinate(g));
  return exponent != 0 && scaled(g, -exponent) ? exponent : 0;
}

/// Rotations are accepted (see Configuration) where they are orthogonal to 1e-9; the proofs take them for exact.
Configuration orthogonalized(const Configuration& c) {
  if ((c.rotation.transpose() * c.rotation - Mat3::Identity()).cwiseAbs().maxCoeff() <= 16.0 * eps) return c;
  return {c.position, Eigen::Quaterniond(c.rotation).normalized().toRotationMatrix(), c.internal_point};
}

/// O in the platform frame.
Vec3 platform_point(const Configuration& c) {
  return c.rotation.transpose() * (c.internal_point - c.position);
}

/// det N times a positive number: of unit rows (Q w) x d with vectors d and w of any length.
double scaled_det_n(const Geometry& g, const InternalPoints& at, const Mat3& rotation) {
  Triple row;
  for (std::size_t i = 0; i < 3; ++i)
    row[i] =
        (rotation * (g.platform_external()[i] - at.o)).normalized().cross((g.base_external()[i] - at.s).normalized());
  return row[0].dot(row[1].cross(row[2]));
}

Tracked tracked(const Step& s, int steps) {
  return {TrackStatus::tracked, s.configuration, s.certificate, s.alone_within, s.separation, steps, 1.0};
}

Tracked not_reached(TrackStatus status, double reached, int steps) {
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
    case TrackStatus::unproved: return "unproved";
  }
  return "";
}

Tracked Tracked::not_tried() {
  const Configuration nowhere{Vec3::Constant(not_a_number), Mat3::Constant(not_a_number), Vec3::Constant(not_a_number)};
  return {TrackStatus::unproved, nowhere, not_a_number, not_a_number, not_a_number, 0, 0.0};
}

Tracker::Tracker(const Geometry& g)
    : exponent_(usable_exponent(g)),
      geometry_(exponent_ == 0 ? g : *scaled(g, -exponent_)),
      base_(geometry_.base_internal()),
      platform_(geometry_.platform_internal()) {}

Tracked Tracker::operator()(const Vec9& leg_lengths, const Configuration& given) const {
  require_leg_lengths(leg_lengths);
  const Configuration start = orthogonalized(given);
  if (exponent_ == 0) return follow(leg_lengths, start);
  Tracked out = follow(scaled(leg_lengths, -exponent_), scaled(start, -exponent_));
  out.configuration = scaled(out.configuration, exponent_);
  return out;
}

Tracked Tracker::follow(const Vec9& leg_lengths, const Configuration& start) const {
  const Vec3 o = platform_point(start);
  const Robot robot{geometry_,           base_,
                    platform_,           base_.height(start.internal_point),
                    platform_.height(o), scaled_det_n(geometry_, {start.internal_point, o}, start.rotation)};
  const double unit = leg_lengths.maxCoeff();
  if (!(std::min(std::abs(robot.base_height), std::abs(robot.platform_height)) > least_height * unit))
    return not_reached(TrackStatus::lost, 0.0, 0);
  const Vec9 from = ninedof::leg_lengths(geometry_, start);
  Waypoint at(robot, from, {start.internal_point, o}, Vec3::Zero());
  const Step whole = step_to(robot, at, leg_lengths, start.rotation);
  if (whole.reach == Reach::yes) return tracked(whole, 1);
  if (whole.reach == Reach::infeasible) return not_reached(TrackStatus::infeasible, 0.0, 0);

  Mat3 rotation = start.rotation;
  double reached = 0.0, stride = 0.5;
  int steps = 0;
  for (int attempt = 0; attempt < most_attempts && stride >= shortest; ++attempt) {
    const double next = std::min(1.0, reached + stride);
    const Vec9 lengths = next < 1.0 ? Vec9(from + next * (leg_lengths - from)) : leg_lengths;
    const Step s = step_to(robot, at, lengths, rotation);
    const double adapted = (next - reached) * std::clamp(aim / s.certificate, 0.1, 4.0);
    if (s.reach != Reach::yes) {
      stride = s.reach == Reach::infeasible ? 0.5 * stride : std::min(0.7 * stride, adapted);
      continue;
    }
    ++steps;
    if (next == 1.0) return tracked(s, steps);
    reached = next;
    rotation = s.configuration.rotation;
    at = Waypoint(robot, lengths, {s.configuration.internal_point, platform_point(s.configuration)}, Vec3::Zero());
    stride = adapted;
  }
  return not_reached(ends_at(robot, at, rotation) ? TrackStatus::lost : TrackStatus::unproved, reached, steps);
}

Tracked track(const Geometry& g, const Vec9& leg_lengths, const Configuration& start) {
  return Tracker(g)(leg_lengths, start);
}

std::vector<Tracked> track(const Geometry& g, std::span<const Vec9> leg_lengths, const Configuration& start,
                           const std::stop_token& stop) {
  const Tracker step(g);
  std::vector<Tracked> out;
  out.reserve(leg_lengths.size());
  Configuration at = start;
  for (const Vec9& lengths : leg_lengths) {
    if (stop.stop_requested()) throw Stopped{};
    const bool stopped = !out.empty() && out.back().status != TrackStatus::tracked;
    out.push_back(stopped ? Tracked::not_tried() : step(lengths, at));
    at = out.back().configuration;
  }
  return out;
}

}  // namespace ninedof
