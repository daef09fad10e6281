#include "ninedof/motion/trajectory.hpp"

#include <cmath>

#include "ninedof/math/error.hpp"

namespace ninedof {

void Trajectory::validate() const {
  if (time.size() < 3) throw InvalidArgument("time", std::to_string(time.size()) + " numbers", "three or more");
  if (poses.size() != time.size())
    throw InvalidArgument("poses", std::to_string(poses.size()), std::to_string(time.size()) + ", one for each time");
  for (std::size_t k = 0; k < time.size(); ++k) {
    require_finite("time", time[k]);
    if (k > 0 && !(time[k] > time[k - 1]))
      throw InvalidArgument("time", format_number(time[k]) + " after " + format_number(time[k - 1]),
                            "increasing times");
    ninedof::validate(Configuration{poses[k].position, poses[k].rotation, Vec3::Zero()});
  }
}

}  // namespace ninedof
