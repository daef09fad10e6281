#include "limits/duty_at_pose.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numeric>
#include <optional>

#include "math/linear/least_squares.hpp"
#include "math/numbers.hpp"
#include "statics/balance.hpp"

namespace ninedof {
namespace {

/// As statics.cpp: where a pivot is smaller, slopes say nothing.
constexpr double surely_regular_duty = 1e-9;

constexpr std::array<int, point_count> every_point = [] {
  std::array<int, point_count> out{};
  std::iota(out.begin(), out.end(), 0);
  return out;
}();

Vec3 vector(const Xyz<double>& v) {
  return {v.x, v.y, v.z};
}

/// H^T f = -load by blocks: O hangs on the internal legs alone, so that the platform has six equations of its own for
/// the external and the upper ones. A tenth of the time of nine equations, which sort out singular poses.
struct ByBlocks {
  explicit ByBlocks(const Mat9& h)
      : platform(Mat6(h.topLeftCorner<6, 6>().transpose())),
        upper(h.block<3, 3>(3, 6).transpose()),
        lower(Mat3(h.bottomRightCorner<3, 3>().transpose())) {
    const auto worst = [](const auto& lu) {
      const auto pivots = lu.matrixLU().diagonal().cwiseAbs().eval();
      return pivots.minCoeff() / pivots.maxCoeff();
    };
    regular = worst(platform) > surely_regular_duty && worst(lower) > surely_regular_duty;
  }
  Vec9 forces(const Load& load, double length) const {
    Vec6 wanted;
    wanted << -load.moment / length, -load.force;
    Vec9 out;
    out.head<6>() = platform.solve(wanted);
    out.tail<3>() = lower.solve(Vec3(-load.force_at_o - upper * out.segment<3>(3)));
    return out;
  }
  Eigen::PartialPivLU<Mat6> platform;
  Mat3 upper;
  Eigen::PartialPivLU<Mat3> lower;
  bool regular;
};
Vec9 near_singular(const Mat9& h, double length, const Load& load) {
  const LegForces found = leg_forces(h, length, load);
  return found.balanced() ? found.forces : Vec9(Vec9::Constant(infinity));
}

}  // namespace

DutyDuals::DutyDuals(const PointLook& look) : DualLook(look, every_point), look_(look) {}

Vec3 DutyAtPose::arm(int point) const {
  return vector(look_.at(point) - look_.at(point_p));
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

double DutyAtPose::force(int leg) {
  const Wrench<double> own = weights(look_, centre_of_mass(look_));
  const ByBlocks blocks(h_);
  double most = -1.0;
  for (const Load& load : duty_.loads) {
    const Load all{load.moment + vector(own.moment), load.force + vector(own.force),
                   load.force_at_o + vector(own.at_o)};
    const Vec9 forces = blocks.regular ? blocks.forces(all, length_) : near_singular(h_, length_, all);
    const double size = std::abs(forces[leg]);
    if (!std::isfinite(size)) return infinity;
    if (size <= most) continue;
    most = size;
    forces_ = forces;
  }
  return most;
}

/// With the motion that moves this leg alone, at unit rate, and the leg forces f held, its force has the slopes of
/// less the power of all forces, which is 0 here: d f_k = -d(motion.(load + H^T f)).
DutySlope DutyAtPose::force_slope(int leg) const {
  DutySlope out;
  const std::optional<Vec9> scaled = solve_regular(h_, Vec9::Unit(leg), surely_regular_duty);
  if (!scaled) return out;
  Vec9 motion = *scaled;
  motion.head<3>() /= length_;
  const DutyDuals duals(look_);
  const Vec3 c = vector(centre_of_mass(look_));
  Wrench<DutyDuals::Number> all = weights(duals, constant<DutyDuals::Number>(c));
  for (int k = 0; k < 9; ++k) all = all + forces_[k] * unit_force(duals, k);
  const double sign = forces_[leg] < 0.0 ? 1.0 : -1.0;
  out.points = sign * power_of(all, motion);
  const Vec3 omega = motion.head<3>();
  out.turn = sign * c.cross((duty_.masses.platform * duty_.gravity).cross(omega));
  return out;
}

double DutyAtPose::rate(int leg) {
  const PlatformMotion& m = duty_.motion;
  if (settles(leg)) {
    for (Eigen::Index k = 0; k < 6; ++k) k_.row(k) = h_.row(k + 3).tail<3>();
    for (Eigen::Index j = 0; j < 6; ++j) {
      const Vec6 y = scale(j) * h_.block<6, 1>(3, j);
      settled_.col(j) = least_norm(k_, Vec6(-y));
      const double left = y[leg - 3] + k_.row(leg - 3).dot(settled_.col(j));
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
DutySlope DutyAtPose::rate_slope(int leg) const {
  const DutyDuals duals(look_);
  const PlatformMotion& m = duty_.motion;
  Vec9 motion = Vec9::Zero();
  motion.head<3>() = m.angular_speed * b_.stableNormalized();
  motion.segment<3>(3) = m.linear_speed * a_.stableNormalized();
  DutySlope out;
  if (!settles(leg)) {
    const RateOf<DutyDuals::Number> found =
        rate_by_rule(unit_force(duals, leg), m.internal, duals.at(point_s) - duals.at(point_p));
    out.points = along(Vec3(motion.head<3>()), found.b) + along(Vec3(motion.segment<3>(3)), found.a);
    return out;
  }
  // Rates r = K sdot + y of the internal legs, K^T r = 0: with x of least squares K x = e_k and rho = e_k - K x
  //     d r_k = rho.(dK sdot + dy) - x.dK^T r.
  const Vec6 twist = motion.head<6>();
  motion.tail<3>() = settled_ * twist;
  const Vec3 x = least_norm(k_, Vec6::Unit(leg - 3));
  const Vec6 rho = Vec6::Unit(leg - 3) - k_ * x;
  for (int k = 3; k < 9; ++k) {
    const Wrench<DutyDuals::Number> w = unit_force(duals, k);
    const DutyDuals::Number rate = power_of(w, motion);
    out.points = out.points + rho[k - 3] * rate - rate.value * along(x, w.at_o);
  }
  return out;
}

}  // namespace ninedof
