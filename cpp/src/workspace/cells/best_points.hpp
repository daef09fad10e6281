#pragma once
/// The best O at many points of a chart, each continued from what was found at two others around it.

#include <mutex>

#include "workspace/criteria/pose_margins.hpp"

namespace ninedof {

/// A point of the chart and the number under which its O is kept.
struct Anchor {
  Vec3 x;
  std::size_t number;
};
using Anchors = std::array<Anchor, 2>;

/// Numbered points and their O, one for each pose of a point. Which anchors a point has must follow from the point alone; then
/// neither the order of the points nor the number of threads matters.
class BestPoints {
 public:
  explicit BestPoints(const Margins& margins) : margins_(margins) {}

  bool needed() const { return margins_.placement().searched(); }
  /// Makes room for numbers below `count`.
  void reserve(std::size_t count);

  /// Places O at a grid of points (the last axis runs fastest) by best_internal_map, and keeps it. Throws Stopped.
  void map(const std::vector<Vec3>& x, const std::vector<std::size_t>& shape, const std::vector<std::size_t>& numbers,
           int threads, const std::stop_token& stop);
  /// Whether O was placed so.
  bool mapped(std::size_t number) const { return mapped_[number] != 0; }

  /// O at the r-th pose of a point that was mapped.
  InternalPoint at(std::size_t number, std::size_t r, const PlatformPose& pose) const;
  /// O at the r-th pose of another point. Where the anchors have O in two places, both are followed. One pose in some hundred is
  /// searched as well, and takes what is better.
  InternalPoint between(const Anchors& from, const Vec3& x, std::size_t r, const PlatformPose& pose);
  void keep(std::size_t number, std::size_t r, const Vec3& s) { kept_[number * margins_.poses() + r] = s; }

  /// Of the maps, and of the poses that were searched as well.
  const MapAudit& audit() const { return audit_; }

 private:
  const Vec3& kept(std::size_t number, std::size_t r) const { return kept_[number * margins_.poses() + r]; }
  double distance(const Vec3& x, const Vec3& y) const;
  void note(const InternalPoint& followed, const InternalPoint& searched);

  const Margins& margins_;
  std::vector<Vec3> kept_;
  std::vector<char> mapped_;
  std::mutex guard_;  // of the audit: counts and a maximum, in whatever order they come
  MapAudit audit_;
};

}  // namespace ninedof
