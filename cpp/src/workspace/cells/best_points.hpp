#pragma once
/// The best O at many points of a chart, each continued from two known points around it.

#include <mutex>

#include "workspace/criteria/limits_at_points.hpp"

namespace ninedof {

/// A point of the chart and the number under which its O is kept.
struct Anchor {
  Vec3 x;
  std::size_t number;
};
using Anchors = std::array<Anchor, 2>;

/// Numbered points and their O, one for each pose of a point. The anchors of a point may depend on that point only: the
/// result then does not depend on the order of the points or on the number of threads.
class BestPoints {
 public:
  explicit BestPoints(const LimitsAtPoints& margins) : margins_(margins) {}

  bool needed() const { return margins_.placement().searched(); }
  /// Makes room for numbers below `count`.
  void reserve(std::size_t count);

  /// Finds and keeps O on a grid of points (the last axis runs fastest) by best_internal_map. Throws Stopped.
  void map(const std::vector<Vec3>& x, const std::vector<std::size_t>& shape, const std::vector<std::size_t>& numbers,
           int threads, const std::stop_token& stop);
  /// Whether O was found by `map`.
  bool mapped(std::size_t number) const { return mapped_[number] != 0; }

  /// O at the r-th pose of a point that was mapped.
  InternalPoint at(std::size_t number, std::size_t r, const PlatformPose& pose) const;
  /// O at the r-th pose of another point. If the anchors are on two branches, both are continued. About one pose in a
  /// hundred is searched as well, and the better O is kept.
  InternalPoint between(const Anchors& from, const Vec3& x, std::size_t r, const PlatformPose& pose);
  void keep(std::size_t number, std::size_t r, const Vec3& s) { kept_[number * margins_.poses() + r] = s; }

  /// The audit of the maps and of the poses searched as well.
  const MapAudit& audit() const { return audit_; }

 private:
  const Vec3& kept(std::size_t number, std::size_t r) const { return kept_[number * margins_.poses() + r]; }
  double distance(const Vec3& x, const Vec3& y) const;
  void note(const InternalPoint& followed, const InternalPoint& searched);

  const LimitsAtPoints& margins_;
  std::vector<Vec3> kept_;
  std::vector<char> mapped_;
  std::mutex guard_;  // of the audit, whose counts and maximum do not depend on the order
  MapAudit audit_;
};

}  // namespace ninedof
