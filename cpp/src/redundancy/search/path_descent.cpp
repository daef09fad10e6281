/// Declared in redundancy/search/descent.hpp.

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/control.hpp"
#include "redundancy/search/descent.hpp"

namespace ninedof {
namespace {

constexpr std::array path_epsilons{3e-2, 3e-3, 1e-4, 1e-6, 1e-8};
constexpr int most_path_steps = 60;  // for one epsilon
constexpr double path_nearly = 1e-3, path_fully = 1e-9;  // decrements for each pose, in epsilons, as in descent.cpp
constexpr double least_curvature = 1e-9;

/// The Hessian with the absolute values of its eigenvalues, at least `floor`: every step is a descent step.
Mat3 convex(const Mat3& hessian, double floor) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(hessian);
  const Vec3 size = eigen.eigenvalues().cwiseAbs();
  const Vec3 raised = size.cwiseMax(std::max(1e-12 * size.maxCoeff(), floor));
  return eigen.eigenvectors() * raised.asDiagonal() * eigen.eigenvectors().transpose();
}

class Path {
 public:
  Path(std::span<PathPoint> points, double coupling, const std::stop_token& stop)
      : points_(points), coupling_(coupling), stop_(stop), s_(lengths()) {}

  bool settle(double epsilon, double enough) {
    double value = evaluate(s_, epsilon, jets_);
    if (!std::isfinite(value)) return false;
    for (int k = 0; k < most_path_steps; ++k) {
      const std::vector<Vec3> way = newton_step();
      if (decrement_ <= enough * epsilon * static_cast<double>(s_.size())) return true;
      if (!step(way, epsilon, value)) return decrement_ <= path_nearly * epsilon * static_cast<double>(s_.size());
    }
    return decrement_ <= path_nearly * epsilon * static_cast<double>(s_.size());
  }

  void keep() {
    for (std::size_t k = 0; k < s_.size(); ++k) points_[k].x = points_[k].objective->pose().scaled(s_[k]);
  }

 private:
  std::vector<Vec3> lengths() const {
    std::vector<Vec3> out;
    for (const PathPoint& point : points_) out.push_back(point.objective->pose().unscaled(point.x));
    return out;
  }

  /// The sum, infinite where a point is outside; derivatives in `jets` are by s.
  double evaluate(const std::vector<Vec3>& s, double epsilon, std::vector<Jet>& jets) const {
    jets.resize(s.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < s.size(); ++k) {
      if (stop_.stop_requested()) throw Stopped{};
      const PoseObjective& objective = *points_[k].objective;
      const double unit = objective.pose().unit();
      if (!objective.soft(objective.pose().scaled(s[k]), epsilon, jets[k])) return infinity;
      jets[k].gradient /= unit;
      jets[k].hessian /= unit * unit;
      sum += jets[k].value;
      if (k > 0) sum += coupling_ * (s[k] - s[k - 1]).squaredNorm();
    }
    return sum;
  }

  /// The Newton step by block elimination; off-diagonal blocks are -2 coupling times the identity.
  std::vector<Vec3> newton_step() {
    const std::size_t n = s_.size();
    std::vector<Vec3> gradient(n), out(n);
    std::vector<Eigen::LLT<Mat3>> pivot(n);
    for (std::size_t k = 0; k < n; ++k) {
      if (stop_.stop_requested()) throw Stopped{};
      Mat3 block = convex(jets_[k].hessian, std::max(least_curvature, 1e-10 * coupling_));
      gradient[k] = jets_[k].gradient;
      for (const std::size_t other : {k - 1, k + 1})  // k - 1 wraps around for k = 0
        if (other < n) {
          gradient[k] += 2.0 * coupling_ * (s_[k] - s_[other]);
          block.diagonal().array() += 2.0 * coupling_;
        }
      out[k] = -gradient[k];
      if (k > 0) {
        block -= 4.0 * coupling_ * coupling_ * pivot[k - 1].solve(Mat3::Identity());
        out[k] += 2.0 * coupling_ * pivot[k - 1].solve(out[k - 1]);
      }
      pivot[k].compute(block);
    }
    decrement_ = 0.0;
    for (std::size_t k = n; k-- > 0;) {
      if (k + 1 < n) out[k] += 2.0 * coupling_ * out[k + 1];
      out[k] = pivot[k].solve(out[k]);
      decrement_ -= out[k].dot(gradient[k]);
    }
    return out;
  }

  bool step(const std::vector<Vec3>& way, double epsilon, double& value) {
    double part = 1.0;
    for (std::size_t k = 0; k < s_.size(); ++k) {  // no point may leave its chamber
      if (stop_.stop_requested()) throw Stopped{};
      const ScaledPose& pose = points_[k].objective->pose();
      part = std::min(part, 0.9 * pose.step_to_singularity(pose.scaled(s_[k]), way[k] / pose.unit(), 2.0));
    }
    const double slack = 8.0 * eps * (1.0 + std::abs(value));
    std::vector<Vec3> next(s_.size());
    for (int halving = 0; halving < 40; ++halving, part *= 0.5) {
      for (std::size_t k = 0; k < s_.size(); ++k) next[k] = s_[k] + part * way[k];
      const double there = evaluate(next, epsilon, trial_);
      if (!(there <= value - 1e-4 * part * decrement_ + slack)) continue;
      s_.swap(next);
      jets_.swap(trial_);
      value = there;
      return true;
    }
    return false;
  }

  std::span<PathPoint> points_;
  double coupling_;
  const std::stop_token& stop_;
  std::vector<Vec3> s_;
  std::vector<Jet> jets_, trial_;
  double decrement_ = 0.0;
};

}  // namespace

bool minimize_path(std::span<PathPoint> points, double coupling, const std::stop_token& stop) {
  Path path(points, coupling, stop);
  bool settled = true;
  for (const double epsilon : path_epsilons)
    settled = path.settle(epsilon, epsilon == path_epsilons.back() ? path_fully : path_nearly);
  path.keep();
  return settled;
}

}  // namespace ninedof
