#include "ninedof/robot/legs.hpp"

#include "support/baseline.hpp"
#include "support/over_poses.hpp"

namespace bench {

Figures legs() {
  const Poses poses = shared_poses();
  for (const Pose& p : *poses) {
    const ninedof::Vec9 expected = plain::leg_lengths(p.geometry, p.configuration);
    require_close("leg lengths", (ninedof::leg_lengths(p.geometry, p.configuration) - expected).cwiseAbs().maxCoeff(),
                  0.0, 1e-14 * expected.maxCoeff());
  }
  return {{over_poses("leg lengths", "plain Eigen", poses, &ninedof::leg_lengths, &plain::leg_lengths)}, {}};
}

}  // namespace bench
