#include "ninedof/kinematics/velocity.hpp"

#include "support/baseline.hpp"
#include "support/baseline_motion.hpp"
#include "support/over_motions.hpp"

namespace bench {
namespace {

ninedof::Vec9 stacked(const ninedof::Velocity& v) {
  ninedof::Vec9 out;
  out << v.omega, v.pdot, v.sdot;
  return out;
}

}  // namespace

Figures velocity() {
  const Poses poses = shared_poses();
  const auto jacobian = [](const auto& g, const auto& c) { return ninedof::jacobian(g, c, length); };
  const auto plain_jacobian = [](const auto& g, const auto& c) { return plain::jacobian(g, c, length); };
  for (const Pose& p : *poses) {
    const ninedof::Mat69 expected = plain_jacobian(p.geometry, p.configuration);
    // Both invert F: rounding errors are multiplied by its condition number.
    const double bound = 1e-14 * plain::condition_number(p.geometry, p.configuration, length) * expected.norm();
    require_close("J'", (jacobian(p.geometry, p.configuration) - expected).norm(), 0.0, bound);
  }

  const auto on = [](auto function) {
    return [function](const MovingPose& m) { return function(m.pose.geometry, m.pose.configuration, m.rates); };
  };
  const auto forward = on(&ninedof::forward_velocity);
  const auto blocks_of_paper = on([](const auto&... a) { return plain::forward_velocity<plain::Factors>(a...); });
  const auto one_system = on([](const auto&... a) { return plain::forward_velocity<plain::NineFactors>(a...); });
  for (const MovingPose& m : *shared_moving_poses()) {
    const ninedof::Vec9 expected = stacked(one_system(m));
    const double bound = 1e-14 * plain::conditioning(m.pose.geometry, m.pose.configuration) * expected.norm();
    require_close("forward velocity", (stacked(forward(m)) - expected).norm(), 0.0, bound);
    require_close("forward velocity by F and B", (stacked(blocks_of_paper(m)) - expected).norm(), 0.0, bound);
  }
  const Target target{"60 ns", [](const Times& t) { return t.ours_median <= 60.0; }};
  return {{over_poses("J' (6x9)", "plain Eigen: F.inverse() * G", poses, jacobian, plain_jacobian),
           over_motions("forward velocity", "plain Eigen: LU of F and B", forward, blocks_of_paper, target),
           over_motions("forward velocity", "plain Eigen: LU of the 9x9 matrix", forward, one_system)},
          {}};
}

}  // namespace bench
