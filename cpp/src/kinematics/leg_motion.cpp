#include "ninedof/kinematics/leg_motion.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "math/linear/jacobi_svd.hpp"
#include "math/linear/least_squares.hpp"

namespace ninedof {
namespace {

using Mat63 = Eigen::Matrix<double, 6, 3>;

Velocity velocity_of(const Geometry& g, const Configuration& c, InternalMotion internal, const Vec6& twist) {
  const Vec3 omega = twist.head<3>(), pdot = twist.tail<3>();
  switch (internal) {
    case InternalMotion::least: return {omega, pdot, internal_velocity(g, c, omega, pdot)};
    case InternalMotion::held: return {omega, pdot, Vec3::Zero()};
    case InternalMotion::shifted: return {omega, pdot, pdot};
    case InternalMotion::carried: break;
  }
  return {omega, pdot, pdot + omega.cross(c.internal_point - c.position)};
}

/// The accelerations of the internal legs for an acceleration of O, as columns; a leg of no length has none.
Mat63 by_internal_point(const Geometry& g, const Configuration& c, InternalMotion internal) {
  if (internal != InternalMotion::least) return Mat63::Zero();  // nobody asks
  const Mat93 all = null_motion(g, c);
  return all.bottomRows<6>().unaryExpr([](double x) { return std::isnan(x) ? 0.0 : x; });
}

/// What remains of the accelerations of the internal legs when that of O makes their squares least.
void settle(const Mat63& by_o, Vec9& accelerations) {
  Vec6 known = accelerations.tail<6>();
  for (double& x : known)
    if (std::isnan(x)) x = 0.0;  // and stays NaN below
  accelerations.tail<6>() -= by_o * least_norm(by_o, known);
}

Vec9 accelerations_of(const Geometry& g, const Configuration& c, InternalMotion internal, const TwistMotion& motion,
                      const Mat63& by_o) {
  const Velocity v = velocity_of(g, c, internal, motion.twist);
  Acceleration a{motion.rate.head<3>(), motion.rate.tail<3>(), Vec3::Zero()};
  const Vec3 arm = c.internal_point - c.position;
  if (internal == InternalMotion::shifted) a.sddot = a.pddot;
  if (internal == InternalMotion::carried) a.sddot = a.pddot + a.alpha.cross(arm) + v.omega.cross(v.omega.cross(arm));
  Vec9 out = inverse_acceleration(g, c, v, a);
  if (internal == InternalMotion::least) settle(by_o, out);
  return out;
}

}  // namespace

Vec9 leg_rates(const Geometry& g, const Configuration& c, InternalMotion internal, const Vec6& twist) {
  return inverse_velocity(g, c, velocity_of(g, c, internal, twist));
}

Vec9 leg_accelerations(const Geometry& g, const Configuration& c, InternalMotion internal, const TwistMotion& motion) {
  return accelerations_of(g, c, internal, motion, by_internal_point(g, c, internal));
}

Vec9 largest_leg_rates(const Geometry& g, const Configuration& c, const PlatformMotion& motion) {
  Eigen::Matrix<double, 9, 6> rates;
  for (Eigen::Index k = 0; k < 6; ++k) rates.col(k) = leg_rates(g, c, motion.internal, Vec6::Unit(k));
  return motion.linear_speed * rates.rightCols<3>().rowwise().norm() +
         motion.angular_speed * rates.leftCols<3>().rowwise().norm();
}

Vec9 largest_leg_accelerations(const Geometry& g, const Configuration& c, const PlatformMotion& motion) {
  const double v = motion.linear_speed, w = motion.angular_speed;
  const Eigen::Index first = w > 0.0 ? 0 : 3, last = v > 0.0 ? 6 : 3;
  const Mat63 by_o = by_internal_point(g, c, motion.internal);
  const auto at = [&](const Vec6& twist) {
    return accelerations_of(g, c, motion.internal, {twist, Vec6::Zero()}, by_o);
  };
  // The form of every leg from its values at unit twists and at their sums.
  std::array<Mat6, 9> form;
  form.fill(Mat6::Zero());
  std::array<Vec9, 6> alone;
  for (Eigen::Index i = first; i < last; ++i) alone[static_cast<std::size_t>(i)] = at(Vec6::Unit(i));
  for (Eigen::Index i = first; i < last; ++i)
    for (Eigen::Index j = i; j < last; ++j) {
      const Vec9 &one = alone[static_cast<std::size_t>(i)], &other = alone[static_cast<std::size_t>(j)];
      const Vec9 mixed = i == j ? one : Vec9(0.5 * (at(Vec6::Unit(i) + Vec6::Unit(j)) - one - other));
      for (std::size_t leg = 0; leg < 9; ++leg)
        form[leg](i, j) = form[leg](j, i) = mixed[static_cast<Eigen::Index>(leg)];
    }
  Vec9 out;
  for (std::size_t leg = 0; leg < 9; ++leg) {
    const Mat6& h = form[leg];
    double& bound = out[static_cast<Eigen::Index>(leg)];
    bound = std::numeric_limits<double>::infinity();
    const auto norm = [&h](Eigen::Index i, Eigen::Index j) { return jacobi_svd(Mat3(h.block<3, 3>(i, j))).sigma[0]; };
    if (h.allFinite()) bound = w * w * norm(0, 0) + v * v * norm(3, 3) + 2.0 * v * w * norm(0, 3);
  }
  return out;
}

}  // namespace ninedof
