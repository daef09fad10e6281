#pragma once
/// Margins of many points of a chart, for every method of a workspace.

#include <array>
#include <functional>
#include <optional>
#include <stop_token>

#include "robot/leg_pairs.hpp"
#include "workspace/chart.hpp"
#include "workspace/criteria/cell_bounds.hpp"
#include "workspace/criteria/limits.hpp"
#include "workspace/criteria/placement.hpp"

namespace ninedof {

/// Room for the margins of a pose and of the region: of each item of a criterion, and one for all pairs of legs. All
/// limits at once have 54.
constexpr int most_groups = 56;

/// The margins of one point. It is allowed if every margin is at least zero.
struct PointMargins {
  std::array<double, most_groups> margin{};
  std::array<std::uint8_t, most_groups> limit{};  ///< index of each margin in limit_names()
  double condition_number = 0.0;

  void put(std::size_t group, double value, int number) {
    margin[group] = value;
    limit[group] = static_cast<std::uint8_t>(number);
  }
  bool allowed(int groups) const {
    for (int g = 0; g < groups; ++g)
      if (!(margin[at_index(g)] >= 0.0)) return false;
    return true;
  }
};

/// The best O at point k of a block with rotation r of the domain.
using BestAt = std::function<InternalPoint(long k, std::size_t r, const PlatformPose& pose)>;

class LimitsAtPoints {
 public:
  LimitsAtPoints(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                 const WorkspaceCriteria& criteria, const std::optional<Configuration>& home);
  LimitsAtPoints(const LimitsAtPoints&) = delete;
  LimitsAtPoints& operator=(const LimitsAtPoints&) = delete;

  const Chart& chart() const { return chart_; }
  const Placement& placement() const { return placement_; }
  /// The poses of a point: one for each rotation of a set.
  std::size_t poses() const { return set_ ? domain_.rotations.size() : 1; }
  PlatformPose pose(const Vec3& x, std::size_t r) const;
  /// The size of the robot, the scale of margins of lengths.
  double size() const { return size_; }
  int groups() const { return groups_; }
  const CellBounds& bounds() const { return *bounds_; }
  /// Whether group g is a leg, a cone or the region, which only `bounds` decide.
  bool bounded(int g) const { return bounded_[at_index(g)]; }
  /// Whether leg lengths, cones and the region are all that limits, so that `bounds` decide everything.
  bool all_bounded() const { return all_bounded_; }
  /// The home pose in the chart.
  const Vec3& home() const { return home_at_; }
  bool in_chart(const Vec3& x) const {
    return (x.array() >= chart_.low().array()).all() && (x.array() <= chart_.high().array()).all();
  }

  /// Number of points to evaluate together: enough for the batch kernels, few enough to stop between two blocks.
  long block() const { return placement_.searched() ? 8 : set_ ? 32 : 512; }

  /// Whether a few thousand more poses cost little.
  bool cheap() const { return !placement_.searched(); }

  /// Throws Stopped. `best` gives O where the rule searches for it; without it each pose is searched.
  void evaluate(const Vec3* x, long count, PointMargins* out, const std::stop_token& stop,
                const BestAt& best = {}) const;

  /// The least margin, of all or of those without bounds, relative to its scale; minus infinity where one is unknown.
  double least(const PointMargins& m, bool without_bounds) const;
  /// Index in limit_names() of the worst negative margin, relative to its scale; -1 for an allowed point.
  int violated(const PointMargins& m) const;

 private:
  struct Block;
  /// Lists the margins of a pose and those that have bounds over cells.
  void list_groups();
  void put_limit(const PoseCriterion& c, const Block& b, long k, const PosedPoints& here, PointMargins& m,
                 std::size_t& next) const;
  void judge(Block& b, const Vec3* x, long count, std::size_t r, const BestAt& best, PointMargins* out) const;
  PointMargins judge_one(const Block& b, long k) const;

  const Geometry& g_;
  WorkspaceDomain domain_;
  WorkspaceCriteria criteria_;
  Chart chart_;
  Placement placement_;
  double size_;
  Configuration home_;
  Vec3 home_at_;
  PosedPoints home_points_;
  std::array<bool, leg_pairs> exempt_;
  std::vector<int> limited_legs_;
  std::vector<PoseCriterion> limits_;  ///< besides those of the legs
  std::array<double, 3> signs_{};
  std::array<double, most_groups> scale_{};  // of each group of one pose
  int pose_groups_ = 0, groups_ = 0;
  bool set_ = false, all_bounded_ = false, looks_at_points_ = false, looks_at_signs_ = false;
  std::optional<CellBounds> bounds_;
  std::array<bool, most_groups> bounded_{};
};

}  // namespace ninedof
