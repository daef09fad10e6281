#include "ninedof/kinematics/acceleration.hpp"

#include "support/baseline_motion.hpp"
#include "support/over_motions.hpp"

namespace bench {
namespace {

ninedof::Vec9 stacked(const ninedof::Acceleration& a) {
  ninedof::Vec9 out;
  out << a.alpha, a.pddot, a.sddot;
  return out;
}

/// A velocity for the derivative of J': nine numbers of the order of 1.
ninedof::Velocity some_velocity(const MovingPose& m) {
  return {m.rates.head<3>(), m.rates.segment<3>(3), m.rates.tail<3>()};
}

}  // namespace

Figures acceleration() {
  const auto on = [](auto function) {
    return [function](const MovingPose& m) {
      return function(m.pose.geometry, m.pose.configuration, m.rates, m.accelerations);
    };
  };
  const auto forward = on(&ninedof::forward_acceleration);
  const auto blocks_of_paper = on([](const auto&... a) { return plain::forward_acceleration<plain::Factors>(a...); });
  const auto one_system = on([](const auto&... a) { return plain::forward_acceleration<plain::NineFactors>(a...); });

  const auto on_velocity = [](auto function) {
    return [function](const MovingPose& m) {
      return function(m.pose.geometry, m.pose.configuration, some_velocity(m), length);
    };
  };
  const auto rate = on_velocity(&ninedof::jacobian_rate);
  const auto plain_rate = on_velocity(&plain::jacobian_rate);

  for (const MovingPose& m : *shared_moving_poses()) {
    // Velocities have an error proportional to the condition number; they are squared and used in another solve.
    const double kappa = plain::conditioning(m.pose.geometry, m.pose.configuration);
    const ninedof::Vec9 expected = stacked(one_system(m));
    const double bound = 1e-14 * kappa * kappa * (1.0 + expected.norm());
    require_close("forward acceleration", (stacked(forward(m)) - expected).norm(), 0.0, bound);
    require_close("forward acceleration by F and B", (stacked(blocks_of_paper(m)) - expected).norm(), 0.0, bound);
    const ninedof::Mat69 derivative = plain_rate(m);
    require_close("derivative of J'", (rate(m) - derivative).norm(), 0.0, 1e-14 * kappa * derivative.norm());
  }
  const Target target{"150 ns", [](const Times& t) { return t.ours_median <= 150.0; }};
  return {{over_motions("forward acceleration", "plain Eigen: LU of F and B", forward, blocks_of_paper, target),
           over_motions("forward acceleration", "plain Eigen: LU of the 9x9 matrix", forward, one_system),
           over_motions("derivative of J'", "plain Eigen: F^-1 (Gdot - Fdot J')", rate, plain_rate)},
          {}};
}

}  // namespace bench
