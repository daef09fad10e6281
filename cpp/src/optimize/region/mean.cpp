#include "optimize/region/mean.hpp"

#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/math/parallel.hpp"
#include "optimize/region/design_at_poses.hpp"
#include "optimize/region/posed.hpp"

namespace ninedof {
namespace {

constexpr int replicates = 8, in_replicate = 1024;
constexpr std::uint64_t fresh_seed = 1'000'003;

/// The harmonic mean of the index at poses.
double harmonic_mean(const Problem& problem, const Region& region, const std::vector<Vec6>& at,
                     const Eigen::VectorXd& x) {
  Problem plain = problem;
  plain.limits.clear();
  DesignAtPoses design(plain, region, own_variables(problem, x));
  double sum = 0.0;
  for (const Vec6& pose : at) {
    design.look_at(pose);
    sum += std::exp(-design.log_index());
  }
  return static_cast<double>(at.size()) / sum;
}

}  // namespace

std::vector<Vec6> mean_nodes(const Region& region, int count, std::uint64_t seed) {
  std::vector<Vec6> out;
  for (int k = 0; k < count; ++k) out.push_back(even_sample(region, k, seed));
  return out;
}

RegionMean region_mean(const Problem& problem, const Region& region, const std::vector<Vec6>& nodes,
                       const Eigen::VectorXd& x, std::uint64_t seed, int threads, const Control& control) {
  Eigen::Array<double, replicates, 1> fresh;
  parallel_for(replicates, 1, threads, [&](long k, long) {
    if (control.stop.stop_requested()) return;
    const auto own = fresh_seed + seed + static_cast<std::uint64_t>(k);
    fresh[k] = harmonic_mean(problem, region, mean_nodes(region, in_replicate, own), x);
  });
  if (control.stop.stop_requested()) throw Stopped{};
  RegionMean out;
  out.nodes = static_cast<int>(nodes.size());
  out.quadrature = harmonic_mean(problem, region, nodes, x);
  out.value = fresh.mean();
  const double variance = (fresh - out.value).square().sum() / (replicates - 1);
  out.standard_error = std::sqrt(variance / replicates);
  out.error = std::abs(out.quadrature - out.value) + 2.0 * out.standard_error;
  return out;
}

}  // namespace ninedof
