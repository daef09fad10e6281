#pragma once
/// The mean of an index over a region: quadrature by evenly spread poses, and its error by fresh ones.

#include "ninedof/optimize/region_study.hpp"

namespace ninedof {

/// Poses of a quadrature: even in the volume or along the path, in the disc of tilts, and in yaws.
std::vector<Vec6> mean_nodes(const Region& region, int count, std::uint64_t seed);

/// The mean of a design over the nodes and over replicates of fresh poses. `x`: variables of the problem without poses
/// of the region.
RegionMean region_mean(const Problem& problem, const Region& region, const std::vector<Vec6>& nodes,
                       const Eigen::VectorXd& x, std::uint64_t seed, int threads, const Control& control);

}  // namespace ninedof
