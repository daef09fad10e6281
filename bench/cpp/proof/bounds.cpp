#include "ninedof/proof/bounds.hpp"

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/proof/closed_form_bounds.hpp"
#include "support/baseline.hpp"
#include "support/over_poses.hpp"

namespace bench {
namespace {

using ninedof::Interval;

/// All numbers of a block at once, as a stack is passed.
using Blocks = std::shared_ptr<const std::vector<double>>;

Blocks hexagonal_rows() {
  auto rows = std::make_shared<std::vector<double>>();
  for (const Variables& x : random_designs()) rows->insert(rows->end(), x.begin(), x.begin() + 6);
  return rows;
}

}  // namespace

Figures proof() {
  const Poses poses = shared_poses();
  for (const Pose& p : *poses) {
    const Interval k = ninedof::condition_number_bounds(p.geometry, p.configuration);
    const double plain = plain::condition_number(p.geometry, p.configuration, 1.0);
    require_close("bounds of the condition number", middle(k), plain, 1e-13 * plain * plain);
    require(plain > 1e6 || width(k) < 1e-13 * plain * plain, "bounds of the condition number are wide");
  }
  const Blocks rows = hexagonal_rows();
  const auto bounds = [rows](std::size_t block) {
    std::array<double, 2 * block_size> out;
    ninedof::hexagonal_condition_number_bounds(rows->data() + 6 * block * block_size, block_size, out.data());
    benchmark::DoNotOptimize(out);
  };
  const auto svd = [](const ninedof::Geometry& g, const ninedof::Configuration& c) {
    return plain::condition_number(g, c, 1.0);
  };
  return {{{"condition number of a hexagon, proved",
            "plain Eigen, not proved",
            blocks,
            block_size,
            bounds,
            each_in_block(poses, [svd](const Pose& p) { return svd(p.geometry, p.configuration); }),
            {"300 ns", [](const Times& t) { return t.ours_median <= 300.0; }}},
           over_poses(
               "condition number at any pose, proved", "plain Eigen, not proved", poses,
               [](const ninedof::Geometry& g, const ninedof::Configuration& c) {
                 return ninedof::condition_number_bounds(g, c).hi;
               },
               svd)},
          {}};
}

}  // namespace bench
