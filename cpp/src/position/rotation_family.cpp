#include "position/rotation_family.hpp"

#include <Eigen/Geometry>

#include "position/simple_mode.hpp"

namespace ninedof {
namespace {

constexpr double member_distance = 1e-3;  // rad: least distance of two members
constexpr double member_step = 0.1;       // rad: from one member to the next
constexpr int member_steps = 24;          // in each direction

}  // namespace

void RotationFamily::add(const PolishedRotation& polished) {
  if (proved() || !polished.converged()) return;
  if (is_simple(problem_, polished, 1.0 / polished.at.inverse_norm(), error_)) return;
  for (std::size_t k = 0; k < count_; ++k)
    if ((member_[k] - polished.rotation).squaredNorm() < 2.0 * member_distance * member_distance) return;
  member_[count_++] = polished.rotation;
}

void RotationFamily::follow() {
  if (count_ == 0) return;
  const PolishedRotation first{member_[0], {problem_, member_[0]}};
  for (const double side : {1.0, -1.0}) {
    PolishedRotation at = first;
    Vec3 direction = side * weakest_direction(at.at);
    for (int step = 0; step < member_steps && !proved(); ++step) {
      const Mat3 turn = Eigen::AngleAxisd(member_step, direction).toRotationMatrix();
      at = polish_rotation(problem_, turn * at.rotation);
      add(at);
      const Vec3 next = weakest_direction(at.at);
      direction = next.dot(direction) < 0.0 ? Vec3(-next) : next;
    }
  }
}

}  // namespace ninedof
