#include "problem/design_state.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "limits/table.hpp"
#include "ninedof/math/rotation.hpp"

namespace ninedof {
namespace {

/// The derivatives of a pose at a fraction of its displacement, where the platform has turned by exp(fraction phi).
PoseSlopes at_fraction(const PoseSlopes& whole, double fraction, double size, const Vec3& phi) {
  PoseSlopes out{fraction * size * whole.position, whole.turn, fraction * size * whole.internal};
  if (fraction != 1.0)
    out.turn = fraction * turn_by_vector(fraction * phi) * turn_by_vector(phi).inverse() * whole.turn;
  return out;
}

}  // namespace

std::vector<PoseSpec> pose_specs(const Problem& problem, const Coordinates& coordinates) {
  std::vector<PoseSpec> specs{{}};
  for (std::size_t k = 0; k < problem.objective.poses.size(); ++k) {
    PoseSpec spec{problem.objective.poses[k], 1.0, offset_variables(problem, k)};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (spec.offset[axis] >= 0) spec.coordinate[axis] = coordinates.coordinate(spec.offset[axis]);
    specs.push_back(spec);
  }
  int steps = 1;
  for (const Limit& limit : problem.limits)
    if (limit.at == LimitAt::poses && limit_row(limit.name).on_the_way()) steps = limit.steps;
  for (std::size_t k = 1; k <= problem.objective.poses.size(); ++k)
    for (int step = 1; step < steps; ++step) {
      PoseSpec between = specs[k];
      between.fraction = static_cast<double>(step) / steps;
      specs.push_back(between);
    }
  return specs;
}

void DesignState::set(const DesignFamily& family, const Problem& problem, const Coordinates& c,
                      const std::vector<PoseSpec>& specs, int objective_poses, const Eigen::VectorXd& y) {
  x = c.variables(y);
  slopes_ = c.slopes(x);
  const std::size_t own = family.variables().size();
  family.blueprint({x.data(), own}, blueprint);
  tool = problem.tool;
  tool_axes_ = tool.axes();
  tool_arm_ = blueprint.theta_z == 0.0 ? tool.position : rotation_about_z(blueprint.theta_z) * tool.position;
  tool_arm_by_theta_z_ = Vec3::UnitZ().cross(tool_arm_);
  columns_ = c.size();
  free_.resize(at_index(c.size()));
  for (int k = 0; k < c.size(); ++k) free_[at_index(k)] = c.variable(k);
  if (column_.size() != own) {
    column_.resize(own);
    for (std::size_t v = 0; v < own; ++v) column_[v] = c.coordinate(static_cast<int>(v));
  }
  jet_.resize(blueprint_rows, 1 + *std::ranges::max_element(column_));
  jet_.setZero();
  for (std::size_t v = 0; v < own; ++v)
    if (column_[v] >= 0)
      jet_.col(column_[v]) = slopes_[column_[v]] * blueprint.gradient.col(static_cast<Eigen::Index>(v));
  first_pose = objective_poses > 0 ? 1 : 0;
  pose_count = std::max(objective_poses, 1);
  poses.resize(specs.size());
  set_poses(specs);
  const bool as_variable = c.length_variable() >= 0;
  set_length(problem.characteristic_length, as_variable ? c.coordinate(c.length_variable()) : -1);
  if (as_variable) characteristic_length = x[c.length_variable()];
}

void DesignState::set_poses(const std::vector<PoseSpec>& specs) {
  moves_ = std::ranges::any_of(specs, [](const PoseSpec& spec) { return spec.slopes.has_value(); });
  for (std::size_t k = 0; k < specs.size(); ++k) place(specs[k], poses[k]);
  set_extremes();
}

void DesignState::set_pose(int k, const PoseSpec& spec) {
  moves_ = moves_ || spec.slopes;
  place(spec, poses[at_index(k)]);
  set_extremes();
}

void DesignState::place(const PoseSpec& spec, PoseState& out) const {
  const std::optional<Vec6> at = spec.follows ? std::optional(spec.follows->at_design(x)) : std::nullopt;
  const std::optional<Pose> moved = at ? std::optional(spec.follows->region.pose(*at)) : std::nullopt;
  const Pose& pose = moved ? *moved : spec.pose;
  const double f = spec.fraction;
  const double size = pose.in_zp ? blueprint.zp : 1.0;
  Vec3 offset = Vec3::Zero();  // of s, in zp
  for (int axis = 0; axis < 3; ++axis)
    if (spec.offset[at_index(axis)] >= 0) offset[axis] = f * x[spec.offset[at_index(axis)]];
  const Vec3 p = Vec3(0.0, 0.0, blueprint.zp) + tool_arm_ + (f * size) * pose.position;
  const Vec3 s = Vec3(0.0, 0.0, blueprint.zs) + (f * size) * pose.internal + blueprint.zp * offset;
  out.p_by_zp = Vec3::UnitZ();
  out.s_by_zp = offset;
  if (pose.in_zp) {
    out.p_by_zp += f * pose.position;
    out.s_by_zp += f * pose.internal;
  }
  const Mat3 turn = pose.rotation.isZero(0.0) ? Mat3::Identity() : exp_rotation(f * pose.rotation);
  out.plate = blueprint.theta_z == 0.0 ? turn : Mat3(turn * rotation_about_z(blueprint.theta_z));
  out.rotation = tool.turned() ? Mat3(out.plate * tool_axes_) : out.plate;
  out.twist_axis = turn.col(2);
  for (std::size_t i = 0; i < 6; ++i) out.at[i] = blueprint.joint[i];
  for (std::size_t i = 6; i < 12; ++i) out.at[i] = p + out.plate * (blueprint.joint[i] - tool.position);
  out.at[point_p] = p;
  out.at[point_s] = s;
  out.legs = nine_legs(out.at);
  out.fraction = f;
  out.coordinate = spec.coordinate;
  out.moves = spec.slopes || at;
  if (out.moves) out.by_at = at_fraction(at ? spec.follows->region.slopes(*at) : *spec.slopes, f, size, pose.rotation);
  out.follows = at.has_value();
  if (at) follow(*spec.follows, out);
}

void DesignState::follow(const FollowingPose& pose, PoseState& out) const {
  const Mat6 by_moved = pose.region.nearest_slopes(pose.moved(x));
  out.at_by_y.setZero(6, columns_);
  for (Eigen::Index k = 0; k < columns_; ++k)
    if (const int v = free_[at_index(k)]; v < pose.variables.size())
      out.at_by_y.col(k) = slopes_[k] * (by_moved * pose.by_variables.col(v));
}

void DesignState::set_extremes() {
  for (int leg = 0; leg < 9; ++leg) {
    int &longest_pose = longest_of[at_index(leg)], &shortest_pose = shortest_of[at_index(leg)];
    longest_pose = shortest_pose = first_pose;
    for (int k = first_pose + 1; k < first_pose + pose_count; ++k) {
      if (pose(k).legs.length[leg] > pose(longest_pose).legs.length[leg]) longest_pose = k;
      if (pose(k).legs.length[leg] < pose(shortest_pose).legs.length[leg]) shortest_pose = k;
    }
    const LegExtreme high{longest_pose, leg}, low{shortest_pose, leg};
    if (leg == 0 || length(high) > length(longest)) longest = high;
    if (leg == 0 || length(low) < length(shortest)) shortest = low;
  }
}

void DesignState::set_length(const StudyLength& study_length, int coordinate) {
  using Choice = StudyLength::Choice;
  if (study_length.choice == Choice::number) {
    characteristic_length = study_length.value;
    return;
  }
  length_gradient.setZero(columns());
  if (study_length.choice == Choice::free || study_length.kind == LengthKind::optimal) {
    if (coordinate >= 0) length_gradient[coordinate] = slopes_[coordinate];
    return;
  }
  const PoseState& home = pose(0);
  if (study_length.kind == LengthKind::mean_leg) {
    characteristic_length = home.legs.length.mean();
    for (int leg = 0; leg < 9; ++leg) add_leg(0, leg, 1.0 / 9.0, length_gradient);
    return;
  }
  if (study_length.kind == LengthKind::platform_radius) {
    int farthest = length_joint >= 0 ? length_joint : point_u;
    for (int k = point_u + 1; k < 12 && length_joint < 0; ++k)
      if (joint_distance(k) > joint_distance(farthest)) farthest = k;
    characteristic_length = joint_distance(farthest);
    if (characteristic_length > 0.0) add_joint(farthest, joint_arm(farthest) / characteristic_length, length_gradient);
    else characteristic_length = trial_length();  // a platform of no size is singular under any length
    return;
  }
  set_natural_length(home);
}

void DesignState::set_natural_length(const PoseState& home) {
  // With a trial length u: |rotation columns of M|_F^2 and |translation columns|_F^2, each a sum over unit twists of
  // the least sum of squared leg rates. The natural length is u times the root of their quotient, for any u.
  const double trial = trial_length();
  PointGradient turning = zero_gradient(), shifting = zero_gradient();
  Spectrum s = spectrum(home.at, home.legs, trial);
  // Any orthonormal set of twists may replace the singular vectors.
  const Mat6 back = s.twist.transpose();
  s.sdot = (s.sdot * back).eval();
  s.rates = (s.rates * back).eval();
  s.twist.setIdentity();
  double rotation = 0.0, translation = 0.0;
  for (int k = 0; k < 6; ++k) {
    (k < 3 ? rotation : translation) += s.rates.col(k).squaredNorm();
    add_spectrum_gradient(home.at, home.legs, s, k, k, 1.0, k < 3 ? turning : shifting);
  }
  characteristic_length = trial * std::sqrt(rotation / translation);
  if (!(characteristic_length > 0.0) || !std::isfinite(characteristic_length)) {
    characteristic_length = trial;  // a singular design: its condition number is infinite under any length
    return;
  }
  for (std::size_t k = 0; k < point_count; ++k)
    turning.point[k] = 0.5 * characteristic_length * (turning.point[k] / rotation - shifting.point[k] / translation);
  turning.length = 0.0;
  Eigen::RowVectorXd gradient = Eigen::RowVectorXd::Zero(columns());
  add(0, turning, gradient);
  length_gradient = gradient;
}

void DesignState::add_joint(int joint, const Vec3& g, Row out) const {
  for (int axis = 0; axis < 3; ++axis) add_jet(g[axis], 3 * joint + axis, out);
}

void DesignState::add_turn(int k, const Vec3& g, Row out) const {
  add_jet(g.dot(pose(k).twist_axis), row_theta_z, out);
  if (pose(k).moves) add_at(pose(k), pose(k).by_at.turn.transpose() * g, out);
}

void DesignState::add_point(int k, int point, const Vec3& g, Row out) const {
  const PoseState& v = pose(k);
  if (point == point_s) {
    add_zs(g.z(), out);
    add_zp(g.dot(v.s_by_zp), out);
    if (v.moves) add_at(v, v.by_at.internal.transpose() * g, out);
    for (int axis = 0; axis < 3; ++axis)
      if (v.coordinate[at_index(axis)] >= 0) out[v.coordinate[at_index(axis)]] += v.fraction * blueprint.zp * g[axis];
    return;
  }
  if (point < 6) return add_joint(point, g, out);
  add_zp(g.dot(v.p_by_zp), out);
  add_jet(g.dot(tool_arm_by_theta_z_), row_theta_z, out);
  if (v.moves) add_at(v, v.by_at.position.transpose() * g, out);
  if (point == point_p) return;
  add_joint(point, v.plate.transpose() * g, out);
  add_turn(k, (v.at[at_index(point)] - v.at[point_p]).cross(g), out);
}

void DesignState::add_leg(int k, int leg, double g, Row out) const {
  const LegEnds ends = leg_ends(leg);
  const Vec3 pull = g * pose(k).legs.direction[at_index(leg)];
  add_point(k, ends.to, pull, out);
  add_point(k, ends.from, -pull, out);
}

void DesignState::add_length(double g, Row out) const {
  if (length_gradient.size() > 0) out.head(length_gradient.size()) += g * length_gradient;
}

void DesignState::add(int k, const PointGradient& g, Row out) const {
  // All points together: the platform's as a force at its point and a turn.
  const PoseState& v = pose(k);
  Eigen::Matrix<double, 1, blueprint_rows> by;
  Vec3 force = g.point[point_p], turn = Vec3::Zero();
  for (std::size_t i = 0; i < point_p; ++i) {
    const Vec3& own = g.point[i];
    auto place = by.segment<3>(3 * static_cast<Eigen::Index>(i)).transpose();
    if (i < point_u) {
      place = own;
      continue;
    }
    place.noalias() = v.plate.transpose() * own;
    force += own;
    turn += (v.at[i] - v.at[point_p]).cross(own);
  }
  by[row_zp] = force.dot(v.p_by_zp);
  by[row_zs] = 0.0;
  by[row_theta_z] = force.dot(tool_arm_by_theta_z_) + turn.dot(v.twist_axis);
  out.head(jet_.cols()).noalias() += by * jet_;
  if (v.moves) add_at(v, v.by_at.position.transpose() * force + v.by_at.turn.transpose() * turn, out);
  add_point(k, point_s, g.point[point_s], out);
  add_length(g.length, out);
}

void DesignState::add_variables(const Eigen::Ref<const Eigen::RowVectorXd>& g, Row out) const {
  for (std::size_t v = 0; v < column_.size(); ++v)
    if (column_[v] >= 0) out[column_[v]] += slopes_[column_[v]] * g[static_cast<Eigen::Index>(v)];
  add_length(g[static_cast<Eigen::Index>(column_.size())], out);
}

}  // namespace ninedof
