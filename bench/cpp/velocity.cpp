#include "ninedof/velocity.hpp"

#include "baseline.hpp"
#include "over_poses.hpp"

namespace bench {
namespace {

constexpr double length = 1.3;  // characteristic; not 1, so that leaving it out would show

}  // namespace

Figures velocity() {
  const Poses poses = shared_poses();
  const auto ours = [](const auto& g, const auto& c) { return ninedof::jacobian(g, c, length); };
  const auto baseline = [](const auto& g, const auto& c) { return plain::jacobian(g, c, length); };
  for (const Pose& p : *poses) {
    const ninedof::Mat69 expected = baseline(p.geometry, p.configuration);
    // Both invert F: each carries a rounding error magnified by its condition number.
    const double bound = 1e-14 * plain::condition_number(p.geometry, p.configuration, length) * expected.norm();
    require_close("J'", (ours(p.geometry, p.configuration) - expected).norm(), 0.0, bound);
  }
  return {{over_poses("J' (6x9)", "plain Eigen: F.inverse() * G", poses, ours, baseline)}, {}};
}

}  // namespace bench
