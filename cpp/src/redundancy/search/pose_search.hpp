#pragma once
/// The ends of a search at one pose: what is settled before it begins, and what its outcome means.

#include <optional>
#include <vector>

#include "math/numbers.hpp"
#include "ninedof/redundancy/redundancy.hpp"
#include "redundancy/search/search.hpp"

namespace ninedof {

/// The limits of external legs that a pose breaks: no internal point can help that.
ActiveBounds external_out_of_limits(const Geometry& g, const Vec3& position, const Mat3& rotation,
                                    const InternalPointProblem& problem);

/// Whether x is off every singularity, so that it lies in a chamber.
bool in_a_chamber(const Scene& scene, const InternalPointProblem& problem, const Vec3& x);

/// Where to start, one point a chamber; none if the start is singular. The default start may happen to lie on det M = 0, the wall
/// between two chambers of which neither is meant: it is then moved to both sides.
std::vector<Vec3> chamber_starts(const Scene& scene, const InternalPointProblem& problem,
                                 const std::optional<Vec3>& start);

/// The internal point at x of the scene, with the bounds it touches.
InternalPoint internal_point(const Merit& merit, const Vec3& x, InternalPointStatus status);

/// What a search of one chamber comes to.
InternalPoint answer(const Merit& merit, const Minima& minima);

/// An answer, and what it takes to go on from it and to compare it.
struct Finding {
  InternalPoint point;
  Vec3 s = Vec3::Zero();      ///< where O is, or where it was lost, or least out of the limits
  Vec3 sides = Vec3::Zero();  ///< of the chamber; zero where the pose alone rules a point out
  double value = infinity;  ///< of Merit::exact
};
Finding finding(const Merit& merit, const Minima& minima);

/// What the pose alone has to say: missing, or infeasible for its external legs; else `singular`, so far.
Finding before_search(const Geometry& g, const Vec3& position, const Mat3& rotation,
                      const InternalPointProblem& problem);

/// best_internal_point without its checks of arguments.
Finding search_pose(const Geometry& g, const Vec3& position, const Mat3& rotation, const InternalPointProblem& problem,
                    const std::optional<Vec3>& start);

/// Whether `a` is the better of two answers for one pose.
bool better(Criterion criterion, const InternalPoint& a, const InternalPoint& b);

}  // namespace ninedof
