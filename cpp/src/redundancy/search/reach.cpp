#include "redundancy/search/reach.hpp"

#include <algorithm>
#include <queue>
#include <utility>
#include <vector>

namespace ninedof {
namespace {

constexpr double grid_reach = 2.0;  // half the edge of the grid, in sizes of the robot
constexpr int grid_points = 40;     // along each axis
constexpr double grid_step = 2.0 * grid_reach / grid_points;
constexpr int first_steps = 3;  // farthest points of the grid to which a search begins, along each axis

bool line_is_free(const ScaledPose& pose, const Vec3& from, const Vec3& to) {
  return pose.step_to_singularity(from, to - from, 1.0) >= 1.0;
}

/// A search over the grid from one point towards another, nearest points first.
class Front {
 public:
  Front(const ScaledPose& pose, const Vec3& from, const Vec3& to)
      : pose_(pose), to_(to), met_(at_index(grid_points * grid_points * grid_points), 0) {
    const Eigen::Vector3i middle = ((from / grid_step).array().floor() + 0.5 * grid_points).cast<int>();
    for (int a = -first_steps; a <= first_steps; ++a)
      for (int b = -first_steps; b <= first_steps; ++b)
        for (int c = -first_steps; c <= first_steps; ++c) meet(from, middle + Eigen::Vector3i(a, b, c));
  }

  bool exhausted() const { return ahead_.empty(); }

  /// Goes on from the nearest point; true if it sees the other end.
  bool advance() {
    const Eigen::Vector3i at = ahead_.top().second;
    ahead_.pop();
    const Vec3 x = point(at);
    if (line_is_free(pose_, x, to_)) return true;
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) meet(x, at + side * Eigen::Vector3i::Unit(axis));
    return false;
  }

 private:
  using Place = std::pair<double, Eigen::Vector3i>;
  struct Farther {
    bool operator()(const Place& a, const Place& b) const { return a.first > b.first; }
  };

  static Vec3 point(const Eigen::Vector3i& at) {
    return ((at.cast<double>().array() + 0.5) * grid_step - grid_reach).matrix();
  }

  void meet(const Vec3& from, const Eigen::Vector3i& at) {
    if ((at.array() < 0).any() || (at.array() >= grid_points).any()) return;
    char& met = met_[at_index((at[0] * grid_points + at[1]) * grid_points + at[2])];
    if (met) return;
    const Vec3 x = point(at);
    if (!line_is_free(pose_, from, x)) return;
    met = 1;
    ahead_.emplace((x - to_).norm(), at);
  }

  const ScaledPose& pose_;
  Vec3 to_;
  std::vector<char> met_;
  std::priority_queue<Place, std::vector<Place>, Farther> ahead_;
};

}  // namespace

bool Reach::reaches(const Vec3& x) {
  if (pose_.volumes(x).cwiseSign() != pose_.volumes(known_.front()).cwiseSign()) return false;
  const auto sees_x = [&](const Vec3& from) { return line_is_free(pose_, from, x); };
  if (std::ranges::any_of(known_, sees_x)) return true;
  if (std::ranges::any_of(beyond_, sees_x)) return false;
  const bool found = finds(x);
  (found ? known_ : beyond_).push_back(x);
  return found;
}

bool Reach::finds(const Vec3& x) const {
  if (std::ranges::any_of(far_, [&](const Vec3& from) { return line_is_free(pose_, from, x); })) return true;
  Front forth(pose_, known_.front(), x), back(pose_, x, known_.front());
  while (!forth.exhausted() && !back.exhausted())
    if (forth.advance() || back.advance()) return true;
  return false;
}

}  // namespace ninedof
