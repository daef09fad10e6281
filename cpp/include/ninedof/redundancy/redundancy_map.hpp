#pragma once
/// Where to put O at very many poses: a grid of them, each continued from its neighbours.

#include <cstdint>
#include <span>
#include <vector>

#include "ninedof/math/control.hpp"
#include "ninedof/redundancy/redundancy.hpp"
#include "ninedof/redundancy/redundancy_path.hpp"

namespace ninedof {

/// The local optimum that `start` leads to, in the chamber of `start`: five to twenty times less work than best_internal_point, whose
/// statuses it has and whose checks it passes.
///
/// `infeasible` for an internal leg says that no point near the start keeps the limits.
InternalPoint nearby_internal_point(const Geometry& g, const Vec3& position, const Mat3& rotation,
                                    const InternalPointProblem& problem, const Vec3& start);

/// Poses on a grid, neighbours along each axis near each other; the last axis runs fastest.
struct PoseGrid {
  std::span<const PlatformPose> poses;
  std::vector<std::size_t> shape;
  std::span<const Vec3> starts;  ///< of the chambers meant: none for default_internal_point, one for all, or one each
};

struct MapSettings {
  std::size_t seed_every = 256;  ///< about one pose in so many is searched with best_internal_point
  std::size_t audit_every = 512;  ///< so is one in so many of the others, 32 at least, once all are placed
  std::uint64_t audit_seed = 0;  ///< which ones
  int threads = 0;  ///< 0: one a processor. The result does not depend on it.
};

/// How often following neighbours missed a better point, by searching poses drawn at random.
struct MapAudit {
  std::size_t poses = 0;  ///< searched
  std::size_t missed = 0;  ///< of them, those where the search found a point better by more than 1e-6 of the value
  double largest = 0.0;  ///< by how much, as a part of the better value; infinite where the map had no point at all
};

struct InternalPointMap {
  std::vector<InternalPoint> points;
  MapAudit audit;  ///< of the map before what the audit found better went into it
  std::size_t searched = 0;  ///< poses given to best_internal_point, those of the audit included
  std::size_t followed = 0;  ///< local optima sought from a neighbour's
  bool complete = true;  ///< false where a stop ended it: poses not placed are `missing`
};

/// The best internal point of every pose of a grid, each in the chamber of its own start.
///
/// A coarse lattice of poses is searched; from there the others are reached in waves, each pose continuing the points of its
/// neighbours, ahead along the line of two where there are two. Wherever the point of a neighbour, continued, is better than what
/// a pose has, it takes its place and is passed on: what remains is the lower envelope of all branches found. What no wave
/// reaches is searched on ever finer lattices. At last an audit searches poses drawn at random; what it finds is passed on too.
///
/// Each wave reads the one before only. Throws InvalidArgument as best_internal_point does, and if the shape or the starts do not fit the
/// poses, or a share is none.
InternalPointMap best_internal_map(const Geometry& g, const PoseGrid& grid, const InternalPointProblem& problem,
                                   const MapSettings& settings = {}, const Control& control = {});

}  // namespace ninedof
