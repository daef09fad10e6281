#pragma once
/// The best internal points of a grid of poses, each continued from its neighbours.

#include <cstdint>
#include <span>
#include <vector>

#include "ninedof/math/control.hpp"
#include "ninedof/redundancy/redundancy.hpp"
#include "ninedof/redundancy/redundancy_path.hpp"

namespace ninedof {

/// Poses on a grid, neighbours along each axis near each other; the last axis runs fastest.
struct PoseGrid {
  std::span<const PlatformPose> poses;
  std::vector<std::size_t> shape;
  /// Points of the chambers to search: empty for default_internal_point, one for all poses, or one for each.
  std::span<const Vec3> starts;
};

struct MapSettings {
  std::size_t seed_every = 256;  ///< about one pose in so many is searched with best_internal_point
  std::size_t audit_every = 512;  ///< at the end one in so many of the others, 32 at least, is searched as well
  std::uint64_t audit_seed = 0;  ///< selects them
  int threads = 0;  ///< 0: one for each processor. The result does not depend on it.
};

/// How often continuation missed a better point, from searches of poses drawn at random.
struct MapAudit {
  static constexpr double deficit = 1e-6;  ///< relative; a value worse by more counts as missed
  std::size_t poses = 0;  ///< searched
  std::size_t missed = 0;  ///< of them, those where the search found a point better by more than `deficit`
  double largest =
      0.0;  ///< greatest such difference, relative to the better value; infinite where the map had no point
};

struct InternalPointMap {
  std::vector<InternalPoint> points;
  MapAudit audit;  ///< of the map before improvements found by the audit were entered
  std::size_t searched = 0;  ///< poses given to best_internal_point, those of the audit included
  std::size_t followed = 0;  ///< local optima continued from a neighbour's
  bool complete = true;  ///< false after a stop: poses not reached are `missing`
};

/// The best internal point of every pose of a grid, each in the chamber of its own start.
///
/// The poses of a coarse lattice are searched. The others are reached by wavefront propagation: each pose continues the
/// points of its neighbours, extrapolated where two lie on one line. A better point replaces that of a pose and is
/// passed on, so that the result is the lower envelope of all branches found. Poses that no front reaches are searched
/// on ever finer lattices. Every pose is then scanned for better valleys. Finally an audit searches poses drawn at
/// random; its improvements are passed on too.
///
/// Each front reads only the one before, so that the result does not depend on the number of threads. Reports the poses
/// placed. Throws InvalidArgument as best_internal_point does, if shape or starts do not fit the poses, or for a zero
/// seed_every or audit_every.
InternalPointMap best_internal_map(const Geometry& g, const PoseGrid& grid, const InternalPointProblem& problem,
                                   const MapSettings& settings = {}, const Control& control = {});

}  // namespace ninedof
