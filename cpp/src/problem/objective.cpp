#include "ninedof/problem/objective.hpp"

#include <cmath>
#include <utility>

#include "ninedof/math/error.hpp"

namespace ninedof {

void Objective::validate() const {
  if (!(weight >= 0.0 && weight <= 1.0))
    throw InvalidArgument("objective.weight", format_number(weight), "a number from 0 to 1");
  for (const auto& [name, limit] : {std::pair{"objective.condition_limit", condition_limit},
                                    std::pair{"objective.neutral_condition_limit", neutral_condition_limit}}) {
    if (!(limit >= 1.0)) throw InvalidArgument(name, format_number(limit), "a number of at least 1");
    if (index == Index::six_legged && std::isfinite(limit))
      throw InvalidArgument(name, format_number(limit),
                            "none with the index six_legged: the limit is of the nine-legged robot");
  }
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose& p = poses[k];
    if (!p.position.allFinite() || !p.rotation.allFinite() || !p.internal.allFinite())
      throw InvalidArgument("objective.poses[" + std::to_string(k) + "]", "a number that is not finite",
                            "finite shifts and rotations");
  }
  bool counted = poses.empty();
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const double w = poses[k].weight;
    if (!(w >= 0.0 && std::isfinite(w)))
      throw InvalidArgument("objective.poses[" + std::to_string(k) + "].weight", format_number(w),
                            "a number of at least 0");
    counted |= w > 0.0;
  }
  if (!counted && aggregate != Aggregate::worst)
    throw InvalidArgument("objective.poses", "no weight above 0", "one that counts in the mean");
  if (index == Index::six_legged && !poses.empty())
    throw InvalidArgument("objective.poses", std::to_string(poses.size()) + " poses",
                          "none: the index six_legged is for the neutral pose");
}

}  // namespace ninedof
