#pragma once
/// Figures over the random poses, each with nine leg rates and nine leg accelerations.

#include "support/over_poses.hpp"

namespace bench {

struct MovingPose {
  Pose pose;
  ninedof::Vec9 rates, accelerations;
};
using MovingPoses = std::shared_ptr<const std::vector<MovingPose>>;

inline MovingPoses shared_moving_poses() {
  static const MovingPoses moving = [] {
    Random random(4);
    const auto nine = [&] { return ninedof::Vec9(ninedof::Vec9::NullaryExpr([&] { return random(-1.0, 1.0); })); };
    std::vector<MovingPose> out;
    for (const Pose& pose : *shared_poses()) {
      const ninedof::Vec9 rates = nine(), accelerations = nine();
      out.push_back({pose, rates, accelerations});
    }
    return std::make_shared<const std::vector<MovingPose>>(std::move(out));
  }();
  return moving;
}

/// A figure of two functions of a MovingPose.
template <class Ours, class Baseline>
Figure over_motions(std::string name, std::string baseline_name, Ours ours, Baseline baseline, Target target = {}) {
  const MovingPoses poses = shared_moving_poses();
  return {std::move(name),  std::move(baseline_name),   blocks,
          block_size,       each_in_block(poses, ours), each_in_block(poses, baseline),
          std::move(target)};
}

}  // namespace bench
