#include "optimize/region/pose_follower.hpp"

#include "math/linear/eigenvectors.hpp"

namespace ninedof {
namespace {

using Ways = Eigen::Matrix<double, 6, Eigen::Dynamic>;

constexpr double step = 1e-3;             // of the differences, in parts of the region
constexpr double least_curvature = 1e-2;  // of the largest: a pose does not follow along what is nearly flat
constexpr double any_curvature = 1e-5;    // of a number over the region: with less it is flat

/// The directions in which a pose can move both ways within the region, or along its round edge; each as long as the
/// region.
Ways free_ways(const Region& region, const Vec6& at) {
  const Vec6 reach = region.reach();
  std::vector<Vec6> out;
  const auto line = [&](Eigen::Index k) {
    if (reach[k] > 0.0 && std::abs(at[k]) < reach[k] * (1.0 - 2.0 * step)) out.push_back(reach[k] * Vec6::Unit(k));
  };
  const auto round = [&](Eigen::Index first, Eigen::Index count) {
    const double radius = reach[first];
    if (radius == 0.0) return;
    Vec3 v = Vec3::Zero();
    v.head(count) = at.segment(first, count) / radius;
    Mat3 within = Mat3::Identity();
    const bool on_edge = v.norm() >= 1.0 - 2.0 * step;
    if (on_edge) {
      const Vec3 across = count == 2 ? Vec3(-v.y(), v.x(), 0.0).normalized() : v.unitOrthogonal();
      within << across, v.cross(across).normalized(), v;
    }
    for (const auto& way : within.leftCols(on_edge ? count - 1 : count).colwise()) {
      out.emplace_back(Vec6::Zero());
      out.back().segment(first, count) = radius * way.head(count);
    }
  };
  switch (region.shape) {
    case Region::Shape::box:
      for (const Eigen::Index k : {0, 1, 2}) line(k);
      break;
    case Region::Shape::ball: round(0, 3); break;
    case Region::Shape::cylinder:
      round(0, 2);
      line(2);
      break;
    case Region::Shape::path: {
      const auto [way, from, to] = region.straight(at[0]);
      if (at[0] - from > 2.0 * step && to - at[0] > 2.0 * step) out.push_back(Vec6::Unit(0));
    }
  }
  round(3, 2);
  line(5);
  Ways ways(6, static_cast<Eigen::Index>(out.size()));
  for (std::size_t k = 0; k < out.size(); ++k) ways.col(static_cast<Eigen::Index>(k)) = out[k];
  return ways;
}

}  // namespace

PoseFollower::PoseFollower(const Problem& problem, const Region& region, const Eigen::VectorXd& x)
    : region_(region),
      variables_(own_variables(problem, x)),
      design_(without_poses(problem), region, variables_, true) {}

std::shared_ptr<const FollowingPose> PoseFollower::following(const Look::Worst& worst) {
  const Ways ways = free_ways(region_, worst.at);
  const Eigen::Index m = ways.cols(), n = variables_.size();
  if (m == 0) return nullptr;
  // Differences of the slopes along the ways, and of those by the variables.
  Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(m, m), mixed = Eigen::MatrixXd::Zero(m, n);
  for (Eigen::Index j = 0; j < m; ++j)
    for (const double side : {1.0, -1.0}) {
      const Vec6 moved = worst.at + side * step * ways.col(j);
      Eigen::RowVectorXd slopes;
      design_.differentiate(worst.number, region_.nearest(moved), slopes);
      const double by = side / (2.0 * step);
      curvature.col(j) += by * (slopes.tail<6>() * region_.nearest_slopes(moved) * ways).transpose();
      mixed.row(j) += by * slopes.head(n);
    }
  if (!curvature.allFinite() || !mixed.allFinite()) return nullptr;
  const auto [values, axes] = symmetric_eigen(0.5 * (curvature + curvature.transpose()));
  const double least = std::max(any_curvature, least_curvature * values.maxCoeff());
  const Eigen::VectorXd inverse = values.unaryExpr([&](double value) { return value > least ? 1.0 / value : 0.0; });
  if (inverse.isZero(0.0)) return nullptr;
  const Ways turned = ways.lazyProduct(axes), moves = (turned * inverse.asDiagonal()).lazyProduct(axes.transpose());
  return std::make_shared<const FollowingPose>(FollowingPose{region_, worst.at, variables_, -moves * mixed});
}

}  // namespace ninedof
