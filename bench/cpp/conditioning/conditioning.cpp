#include "ninedof/conditioning/conditioning.hpp"

#include "support/baseline.hpp"
#include "support/over_poses.hpp"

namespace bench {

Figures conditioning() {
  const Poses poses = shared_poses();
  const auto ours = [](const auto& g, const auto& c) { return ninedof::condition_number(g, c, length); };
  const auto svd = [](const auto& g, const auto& c) { return plain::condition_number(g, c, length); };
  const auto squared = [](const auto& g, const auto& c) { return plain::squared_condition_number(g, c, length); };
  for (const Pose& p : *poses) {
    const double kappa = ours(p.geometry, p.configuration);
    require_close("condition number", kappa, svd(p.geometry, p.configuration), 1e-13 * kappa * kappa);
    require_close("condition number", kappa, squared(p.geometry, p.configuration), 1e-13 * kappa * kappa * kappa);
  }
  const Target target{"4 times faster", [](const Times& t) { return t.speedup >= 4.0; }};
  return {{over_poses("condition number, general", "plain Eigen: J', JacobiSVD", poses, ours, svd, target),
           over_poses("condition number, general", "plain Eigen: J', eigenvalues of J'J'^T", poses, ours, squared)},
          {}};
}

}  // namespace bench
