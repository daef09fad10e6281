#include "redundancy/search/scan.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/batch/batch.hpp"

namespace ninedof {
namespace {

constexpr double box_reach = 1.5;  // half the edge of the box without limits, in sizes of the robot
constexpr int box_points = 8;  // of the grid that tightens the box, along each axis
constexpr double worthwhile = 0.7;  // part of the volume of a box; if more is left, it is tight enough
constexpr int most_tightenings = 4;
constexpr double few = 0.25;  // share of allowed points below which their box is scanned again

/// A box, divided into cells for a grid of points.
struct Box {
  Vec3 low, high;

  bool empty() const { return !(low.array() < high.array()).all(); }
  double volume() const { return (high - low).prod(); }
  Vec3 cell(int n) const { return (high - low) / n; }
  /// The middle of cell k of n along each axis.
  Vec3 point(int k, int n) const {
    return low + (Vec3(k / (n * n), k / n % n, k % n).array() + 0.5).matrix().cwiseProduct(cell(n));
  }
  /// Extends to the box around x.
  void include(const Vec3& x, const Vec3& half) {
    low = low.cwiseMin(x - half);
    high = high.cwiseMax(x + half);
  }
  static Box nothing() { return {Vec3::Constant(infinity), Vec3::Constant(-infinity)}; }
};

bool is_limited(const ScaledPose& pose) {
  return (pose.low().array() > 0.0).any() || pose.high().minCoeff() < infinity;
}

/// The box around what the upper limits allow, at most the surroundings of the robot.
Box box_of_limits(const ScaledPose& pose) {
  Box box{Vec3::Constant(-box_reach), Vec3::Constant(box_reach)};
  for (int k = 0; k < 6; ++k) {
    const Vec3 reach = Vec3::Constant(pose.high()[k]);
    box.low = box.low.cwiseMax(pose.joint(k) - reach);
    box.high = box.high.cwiseMin(pose.joint(k) + reach);
  }
  return box;
}

/// The part of a box that keeps the limits. The violation grows no faster than the way: in the middle of a cell with an
/// allowed point it is at most half the diagonal.
Box tightened(const PoseObjective& objective, const Box& box) {
  const Vec3 half = 0.5 * box.cell(box_points);
  Box out = Box::nothing();
  for (int k = 0; k < box_points * box_points * box_points; ++k) {
    const Vec3 x = box.point(k, box_points);
    if (objective.violation(x) <= half.norm()) out.include(x, half);
  }
  return out;
}

Box box_to_scan(const PoseObjective& objective) {
  Box box = box_of_limits(objective.pose());
  if (!is_limited(objective.pose())) return box;
  for (int k = 0; k < most_tightenings && !box.empty(); ++k) {
    const double before = box.volume();
    box = tightened(objective, box);
    if (!box.empty() && box.volume() > worthwhile * before) break;
  }
  return box;
}

/// The criterion and the violation of the limits on the points of a grid in a box; infinite where not allowed.
class Grid {
 public:
  Grid(const PoseObjective& objective, const Box& box, int n) : objective_(objective), box_(box), n_(n) {
    const std::size_t count = at_index(n) * at_index(n) * at_index(n);
    value_.assign(count, infinity);
    violation_.assign(count, infinity);
    find_allowed();
    evaluate();
  }

  double cell() const { return box_.cell(n_).norm(); }
  bool few_allowed() const {
    return !allowed_.empty() && static_cast<double>(allowed_.size()) < few * static_cast<double>(value_.size());
  }

  Box allowed_box() const {
    Box out = Box::nothing();
    for (const int k : allowed_) out.include(box_.point(k, n_), box_.cell(n_));
    return out;
  }

  std::vector<Valley> valleys() const {
    std::vector<Valley> out;
    for (const int k : allowed_)
      if (is_least(value_, k)) out.push_back({box_.point(k, n_), value_[at_index(k)], drop(k)});
    std::ranges::stable_sort(out, {}, &Valley::value);
    return out;
  }

  /// Farther from the limits than a cell, an allowed point would be nearer to other points of the grid.
  std::vector<Vec3> outside() const {
    std::vector<std::pair<double, int>> found;
    for (int k = 0; k < static_cast<int>(violation_.size()); ++k) {
      const double broken = violation_[at_index(k)];
      if (broken > limit_tolerance && broken < cell() && is_least(violation_, k)) found.emplace_back(broken, k);
    }
    std::ranges::sort(found);
    std::vector<Vec3> out;
    for (const auto& [broken, k] : found) out.push_back(box_.point(k, n_));
    return out;
  }

 private:
  /// The points of the chamber within the limits. Those below the clearance are kept: a better point may be near.
  void find_allowed() {
    const ScaledPose& pose = objective_.pose();
    const bool limited = is_limited(pose);
    for (int k = 0; k < static_cast<int>(value_.size()); ++k) {
      const Vec3 x = box_.point(k, n_);
      if (pose.volumes(x).cwiseSign() != objective_.signs()) continue;
      if (limited) violation_[at_index(k)] = objective_.violation(x);
      if (!limited || violation_[at_index(k)] <= limit_tolerance) allowed_.push_back(k);
    }
  }

  void evaluate() {
    if (allowed_.empty()) return;
    const ScaledPose& pose = objective_.pose();
    const InternalPointProblem& problem = objective_.problem();
    std::vector<Vec3> s;
    for (const int k : allowed_) s.push_back(pose.unscaled(box_.point(k, n_)));
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = pose.rotation();
    const batch::Configurations all{
        pose.position().data(), rotation.data(), s[0].data(), static_cast<long>(s.size()), 0, 0, 3};
    std::vector<double> found(3 * s.size());
    if (problem.criterion == Criterion::singularity) batch::singularity_margins(pose.geometry(), all, found.data());
    if (problem.criterion == Criterion::condition_number)
      batch::condition_numbers(pose.geometry(), all, {&problem.characteristic_length, 0}, Norm::two, found.data());
    for (std::size_t k = 0; k < s.size(); ++k) {
      double& value = value_[at_index(allowed_[k])];
      switch (problem.criterion) {
        case Criterion::condition_number: value = std::log(found[k]); break;
        case Criterion::singularity:
          value = -std::log(Eigen::Map<const Vec3>(&found[3 * k]).cwiseAbs().minCoeff());
          break;
        case Criterion::leg_centring: value = objective_.exact(box_.point(allowed_[k], n_)); break;
      }
    }
  }

  /// Calls visit(neighbour, axis) for the up to 26 points around point k, until it is false; the axis is 3 for
  /// diagonals.
  template <class Visit>
  void neighbours(int k, Visit visit) const {
    const int n = n_, x = k / (n * n), y = k / n % n, z = k % n;
    for (int a = std::max(0, x - 1); a <= std::min(n - 1, x + 1); ++a)
      for (int b = std::max(0, y - 1); b <= std::min(n - 1, y + 1); ++b)
        for (int c = std::max(0, z - 1); c <= std::min(n - 1, z + 1); ++c) {
          const bool moved[] = {a != x, b != y, c != z};
          const int axes = moved[0] + moved[1] + moved[2];
          if (axes == 0) continue;
          const int axis = axes > 1 ? 3 : moved[0] ? 0 : moved[1] ? 1 : 2;
          if (!visit((a * n + b) * n + c, axis)) return;
        }
  }

  bool is_least(const std::vector<double>& of, int k) const {
    const double mine = of[at_index(k)];
    bool least = mine < infinity;
    neighbours(k, [&](int j, int) {
      const double other = of[at_index(j)];
      return least = least && (other > mine || (other == mine && j > k));
    });
    return least;
  }

  /// A convex function falls on one side no more than it rises on the other: by half that in half a cell.
  double drop(int k) const {
    Vec3 rise = Vec3::Constant(-1.0);
    double greatest = -1.0;
    neighbours(k, [&](int j, int axis) {
      const double by = value_[at_index(j)] - value_[at_index(k)];
      if (!(by < infinity)) return true;
      greatest = std::max(greatest, by);
      if (axis < 3) rise[axis] = std::max(rise[axis], by);
      return true;
    });
    if (greatest < 0.0) return infinity;  // alone
    return 0.5 * (rise.array() < 0.0).select(greatest, rise).sum();
  }

  const PoseObjective& objective_;
  Box box_;
  int n_;
  std::vector<int> allowed_;
  std::vector<double> value_, violation_;
};

}  // namespace

Scan scan(const PoseObjective& objective, int n) {
  const Box box = box_to_scan(objective);
  if (box.empty()) return {};
  const Grid whole(objective, box, n);
  if (!whole.few_allowed()) return {whole.valleys(), whole.outside(), whole.cell()};
  const Grid close(objective, whole.allowed_box(), n);
  return {close.valleys(), whole.outside(), close.cell()};
}

}  // namespace ninedof
