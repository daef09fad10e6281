#pragma once
/// Figures over the same random poses.

#include <benchmark/benchmark.h>

#include <memory>
#include <utility>

#include "support/data.hpp"
#include "support/figure.hpp"

namespace bench {

using Poses = std::shared_ptr<const std::vector<Pose>>;

inline Poses shared_poses() {
  static const Poses poses = std::make_shared<const std::vector<Pose>>(random_poses());
  return poses;
}

/// Calls `function(item)` on the items of one block. A template, so that a baseline that can be inlined is.
template <class Items, class Function>
auto each_in_block(Items items, Function function) {
  return [items, function](std::size_t block) {
    for (std::size_t k = block * block_size; k < (block + 1) * block_size; ++k)
      benchmark::DoNotOptimize(function((*items)[k]));
  };
}

/// A figure of two functions of (geometry, configuration).
template <class Ours, class Baseline>
Figure over_poses(std::string name, std::string baseline_name, const Poses& poses, Ours ours, Baseline baseline,
                  Target target = {}) {
  const auto on_pose = [&](auto function) {
    return each_in_block(poses, [function](const Pose& p) { return function(p.geometry, p.configuration); });
  };
  return {std::move(name), std::move(baseline_name), blocks,           block_size,
          on_pose(ours),   on_pose(baseline),        std::move(target)};
}

}  // namespace bench
