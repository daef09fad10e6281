#include "limits/duty_at_pose.hpp"

#include <cmath>

#include "math/linear/least_squares.hpp"
#include "math/numbers.hpp"
#include "statics/balance.hpp"

namespace ninedof {
namespace {

/// As statics.cpp: where a pivot is smaller, slopes say nothing.
constexpr double surely_regular_duty = 1e-9;

Vec3 vector(const Xyz<double>& v) {
  return {v.x, v.y, v.z};
}

template <class Lu>
bool surely_regular_lu(const Lu& lu) {
  const auto pivots = lu.matrixLU().diagonal().cwiseAbs().eval();
  return pivots.minCoeff() / pivots.maxCoeff() > surely_regular_duty;
}

Vec9 near_singular(const Mat9& h, double length, const Load& load) {
  const LegForces found = leg_forces(h, length, load);
  return found.balanced() ? found.forces : Vec9(Vec9::Constant(infinity));
}

/// Of the power of a force at a point of the platform: its arm from p changes.
void add_arm(int point, const Vec3& force, const Vec9& motion, PointSlopes& out) {
  const Vec3 by = force.cross(Vec3(motion.head<3>()));
  out.at[at_index(point)].slope += by;
  out.at[point_p].slope -= by;
}

}  // namespace

ByBlocks::ByBlocks(const Mat9& h)
    : platform_(Mat6(h.topLeftCorner<6, 6>().transpose())),
      upper_(h.block<3, 3>(3, 6).transpose()),
      lower_(Mat3(h.bottomRightCorner<3, 3>().transpose())),
      regular_(surely_regular_lu(platform_) && surely_regular_lu(lower_)) {}

Vec9 ByBlocks::forces(const Vec9& wanted) const {
  Vec9 out;
  out.head<6>() = platform_.solve(Vec6(wanted.head<6>()));
  out.tail<3>() = lower_.solve(Vec3(wanted.tail<3>() - upper_ * out.segment<3>(3)));
  return out;
}

Vec9 ByBlocks::motion(int leg) const {
  Vec9 out = Vec9::Unit(leg);
  out.tail<3>() = lower_.transpose().solve(Vec3(out.tail<3>()));
  out.segment<3>(3) -= upper_.transpose() * out.tail<3>();
  out.head<6>() = platform_.transpose().solve(Vec6(out.head<6>()));
  return out;
}

DutyAtPose::DutyAtPose(const PointLook& look) : look_(look), duty_(look.duty()) {
  for (int k = point_u; k < point_p; ++k) length_ = std::max(length_, arm(k).norm());
  if (!(length_ > 0.0)) length_ = 1.0;
  for (int leg = 0; leg < 9; ++leg) {
    unit_[at_index(leg)] = unit_force(look, leg);
    const Wrench<double>& w = unit_[at_index(leg)];
    h_.row(leg) << vector(w.moment).transpose() / length_, vector(w.force).transpose(), vector(w.at_o).transpose();
  }
}

void DutyAtPose::balance() {
  const Wrench<double> own = weights(look_, centre_of_mass(look_));
  blocks_.emplace(h_);
  for (const Load& load : duty_.loads) {
    const Load all{load.moment + vector(own.moment), load.force + vector(own.force),
                   load.force_at_o + vector(own.at_o)};
    Vec9 wanted;
    wanted << -all.moment / length_, -all.force, -all.force_at_o;
    forces_.push_back(blocks_->regular() ? blocks_->forces(wanted) : near_singular(h_, length_, all));
  }
}

double DutyAtPose::force(int leg) {
  if (!blocks_) balance();
  double most = -1.0;
  for (const Vec9& forces : forces_) {
    const double size = std::abs(forces[leg]);
    if (!std::isfinite(size)) return infinity;
    if (size <= most) continue;
    most = size;
    ruling_ = forces;
  }
  return most;
}

Vec3 DutyAtPose::velocity(int point, const Vec9& motion) const {
  if (point == point_s) return motion.tail<3>();
  if (point < point_u) return Vec3::Zero();
  return motion.segment<3>(3) + Vec3(motion.head<3>()).cross(arm(point));
}

/// Adds the slopes of the power of a leg's force, and of its weight, in a motion that is held.
void DutyAtPose::add_power(int leg, double force, bool weighs, const Vec9& motion, PointSlopes& out) const {
  const LegEnds ends = leg_ends(leg);
  const Vec3 e = vector(look_.direction(leg)), v = velocity(ends.to, motion) - velocity(ends.from, motion);
  const double length = look_.here().legs.length[leg], per_length = length == 0.0 ? 0.0 : 1.0 / length;
  const auto across = [&](const Vec3& u) { return Vec3(per_length * (u - e.dot(u) * e)); };
  Vec3 from = -force * e, to = force * e, span = force * across(v);
  const Masses& m = duty_.masses;
  if (weighs && (m.cylinder[leg] != 0.0 || m.rod[leg] != 0.0)) {
    const Vec3 cylinder = m.cylinder[leg] * duty_.gravity, rod = m.rod[leg] * duty_.gravity;
    const Vec3 both = m.cylinder_centre[leg] * cylinder - m.rod_centre[leg] * rod, turning = across(both);
    from += cylinder - turning;
    to += rod + turning;
    span -= per_length * (turning.dot(v) * e + e.dot(v) * turning + e.dot(both) * across(v));
  }
  out.at[at_index(ends.to)].slope += span;
  out.at[at_index(ends.from)].slope -= span;
  if (leg < 3) add_arm(ends.to, to, motion, out);
  else if (leg < 6) add_arm(ends.from, from, motion, out);
}

/// With the motion that moves this leg alone, at unit rate, and the leg forces f held, its force has the slopes of
/// less the power of all forces, which is 0 here: d f_k = -d(motion.(load + H^T f)).
void DutyAtPose::add_force_slope(int leg, double by, PointSlopes& out) const {
  const std::optional<Vec9> scaled =
      blocks_->regular() ? blocks_->motion(leg) : solve_regular(h_, Vec9::Unit(leg), surely_regular_duty);
  if (!scaled) return;
  Vec9 motion = (ruling_[leg] < 0.0 ? by : -by) * *scaled;
  motion.head<3>() /= length_;
  for (int k = 0; k < 9; ++k) add_power(k, ruling_[k], true, motion, out);
  const Vec3 weight = duty_.masses.platform * duty_.gravity;
  out.turn += vector(centre_of_mass(look_)).cross(weight.cross(Vec3(motion.head<3>())));
}

void DutyAtPose::settle() {
  settled_.emplace();
  for (Eigen::Index k = 0; k < 6; ++k) k_.row(k) = h_.row(k + 3).tail<3>();
  for (Eigen::Index j = 0; j < 6; ++j) settled_->col(j) = least_norm(k_, Vec6(-scale(j) * h_.block<6, 1>(3, j)));
}

double DutyAtPose::rate(int leg) {
  const PlatformMotion& m = duty_.motion;
  if (settles(leg)) {
    if (!settled_) settle();
    for (Eigen::Index j = 0; j < 6; ++j) {
      const double left = scale(j) * h_(leg, j) + k_.row(leg - 3).dot(settled_->col(j));
      (j < 3 ? b_[j] : a_[j - 3]) = left;
    }
  } else {
    const RateOf<double> found = rate_by_rule(unit_[at_index(leg)], m.internal, PointLook::xyz(arm(point_s)));
    a_ = vector(found.a);
    b_ = vector(found.b);
  }
  return m.linear_speed * a_.norm() + m.angular_speed * b_.norm();
}

/// Of the rate for the twist that is worst here.
void DutyAtPose::add_rate_slope(int leg, double by, PointSlopes& out) const {
  const PlatformMotion& m = duty_.motion;
  Vec9 motion = Vec9::Zero();
  motion.head<3>() = by * m.angular_speed * b_.stableNormalized();
  motion.segment<3>(3) = by * m.linear_speed * a_.stableNormalized();
  if (!settles(leg)) {
    const bool carried = m.internal == InternalMotion::carried;
    if (m.internal == InternalMotion::shifted) motion.tail<3>() = motion.segment<3>(3);
    if (carried) motion.tail<3>() = motion.segment<3>(3) + Vec3(motion.head<3>()).cross(arm(point_s));
    add_power(leg, 1.0, false, motion, out);
    if (carried) add_arm(point_s, vector(unit_[at_index(leg)].at_o), motion, out);
    return;
  }
  // Rates r = K sdot + y of the internal legs, K^T r = 0: with x of least squares K x = e_k and rho = e_k - K x
  //     d r_k = rho.(dK sdot + dy) - x.dK^T r.
  motion.tail<3>() = *settled_ * Vec6(motion.head<6>());
  const Vec3 x = least_norm(k_, Vec6::Unit(leg - 3));
  const Vec6 rho = Vec6::Unit(leg - 3) - k_ * x;
  Vec9 alone = Vec9::Zero();
  alone.tail<3>() = x;
  for (int k = 3; k < 9; ++k) {
    add_power(k, rho[k - 3], false, motion, out);
    add_power(k, -power_of(unit_[at_index(k)], motion), false, alone, out);
  }
}

}  // namespace ninedof
