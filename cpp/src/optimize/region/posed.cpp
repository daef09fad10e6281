#include "optimize/region/posed.hpp"

#include <algorithm>

#include "ninedof/domains/region_sample.hpp"
#include "problem/full_variables.hpp"

namespace ninedof {
namespace {

constexpr int first_turns = 4;  // directions of the tilt at the corners

/// The corners of a path, with the turns of a pose.
std::vector<Vec6> at_corners(const Region& region, const Vec6& turned) {
  std::vector<double> along{0.0};
  for (std::size_t k = 1; k < region.corners.size(); ++k)
    along.push_back(along.back() + (region.corners[k] - region.corners[k - 1]).norm());
  std::vector<Vec6> out(along.size(), turned);
  for (std::size_t k = 0; k < along.size(); ++k)
    out[k][0] = along.back() > 0.0 ? 2.0 * along[k] / along.back() - 1.0 : 0.0;
  return out;
}

std::vector<Vec6> distinct(const std::vector<Vec6>& all) {
  std::vector<Vec6> out;
  for (const Vec6& at : all)
    if (std::ranges::find(out, at) == out.end()) out.push_back(at);
  return out;
}

/// Home and the corners of a region, those of a path all along it.
std::vector<Vec6> home_and_corners(const Region& region, int turns) {
  std::vector<Vec6> out{Vec6::Zero()};
  for (const Vec6& corner : region_corners(region, turns)) {
    if (region.shape == Region::Shape::path) std::ranges::copy(at_corners(region, corner), std::back_inserter(out));
    else out.push_back(corner);
  }
  return out;
}

}  // namespace

std::vector<Vec6> cover(const Region& region) {
  return distinct(home_and_corners(region, first_turns));
}

std::vector<Vec6> coarse_cover(const Region& region) {
  Region unturned = region;
  unturned.tilt = unturned.yaw = 0.0;
  std::vector<Vec6> out = home_and_corners(unturned, 1);
  const Vec6 reach = region.reach();
  for (Eigen::Index k = 3; k < 6; ++k)
    for (const double sign : {1.0, -1.0})
      if (reach[k] > 0.0) out.emplace_back(sign * reach[k] * Vec6::Unit(k));
  return distinct(out);
}

std::vector<Pose> poses_of(const Problem& problem, const Region& region, const Imposed& imposed) {
  std::vector<Pose> out;
  for (const Vec6& at : imposed.nodes) out.push_back(region.pose(at));
  for (const Vec6& at : imposed.at) {
    out.push_back(region.pose(at));
    out.back().weight = problem.objective.aggregate == Aggregate::worst ? 1.0 : 0.0;
  }
  return out;
}

Problem posed(const Problem& problem, const std::vector<Pose>& poses) {
  Problem out = problem;
  out.objective.poses.insert(out.objective.poses.end(), poses.begin(), poses.end());
  return out;
}

Problem without_poses(Problem problem) {
  problem.objective.poses.clear();
  problem.objective.aggregate = Aggregate::worst;
  return problem;
}

Problem with_one_pose(Problem problem) {
  problem.objective.aggregate = Aggregate::worst;
  problem.objective.poses = {{}};
  problem.objective.poses.front().position = Vec3(1.0, 0.5, 0.0);
  return problem;
}

Eigen::VectorXd own_variables(const Problem& problem, const Eigen::VectorXd& x) {
  return x.head(static_cast<Eigen::Index>(without_poses(problem).names().size()));
}

Eigen::VectorXd with_shifts(const Problem& problem, const Eigen::VectorXd& own, const std::vector<Vec3>& shifts) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.names().size()));
  out.head(own.size()) = own;
  for (std::size_t k = 0; k < shifts.size(); ++k) {
    const std::array<int, 3> offset = offset_variables(problem, k);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (offset[axis] >= 0) out[offset[axis]] = shifts[k][static_cast<Eigen::Index>(axis)];
  }
  return out;
}

Vec3 shifted_with(const Pose& pose, double zp) {
  return pose.position / (pose.in_zp ? 1.0 : zp);
}

double distance_in(const Region& region, const Vec6& a, const Vec6& b) {
  const Vec6 reach = region.reach();
  double out = 0.0;
  for (Eigen::Index k = 0; k < 6; ++k)
    if (reach[k] > 0.0) out = std::max(out, std::abs(a[k] - b[k]) / reach[k]);
  return out;
}

}  // namespace ninedof
