#pragma once
/// Direct position analysis for control: the assembly mode a robot goes on in from where it is known to be.

#include <span>
#include <vector>

#include "ninedof/math/types.hpp"
#include "ninedof/position/trilateration.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

enum class TrackStatus {
  tracked,     ///< reached, and certified to be the only mode near the last step's start
  lost,  ///< not reached: on the straight way of the lengths the mode meets another, or a plane of the internal joints
  infeasible,  ///< the internal legs do not meet, or an external leg is too long or too short for O where it is
};

/// "tracked", "lost", "infeasible".
const char* to_string(TrackStatus status);

/// A configuration and what is known about it.
struct Tracked {
  TrackStatus status = TrackStatus::lost;
  Configuration configuration;  ///< NaN unless tracked
  /// Kantorovich's number sqrt(3) beta eta at the start of the last step, for its lengths and sides of O. At 1/2 and below it is
  /// proved that a mode exists near the start and which one it is. Above, the mode reached is certified from its own side: its
  /// `separation` proves that Newton's method comes to it from the start. Either way the start alone says where the robot went: lengths
  /// between the two ends of a step are not looked at.
  double certificate;
  /// No second mode of the same sides of O is nearer than this to the start of the last step, rad. NaN where the certificate is above 1/2.
  double alone_within;
  double separation;  ///< as in AssemblyMode: 0 where two modes meet
  int steps = 0;  ///< 1, or into how many the way had to be divided
  double reached = 0.0;  ///< fraction of the way from the lengths of the start: 1 if tracked

  /// Lost before the first step, as all is that follows a lost one: NaN, no steps, nothing reached.
  static Tracked not_tried();
};

/// Follows one robot. Made once, since the planes of its internal joints do not change.
class Tracker {
 public:
  explicit Tracker(const Geometry& g);

  /// The mode reached from `start` when the lengths go straight from those of `start` to `leg_lengths`. O stays on its side of both
  /// planes of internal joints, where it is known in closed form; the rotation follows by Newton's method, in steps short enough to be
  /// certified.
  ///
  /// Throws InvalidArgument for lengths that are not finite or negative.
  Tracked operator()(const Vec9& leg_lengths, const Configuration& start) const;

 private:
  Geometry geometry_;
  SphereCentres base_, platform_;
};

/// One step, or each of a sequence from the one before; from the first that is not tracked on, none is.
Tracked track(const Geometry& g, const Vec9& leg_lengths, const Configuration& start);
std::vector<Tracked> track(const Geometry& g, std::span<const Vec9> leg_lengths, const Configuration& start);

}  // namespace ninedof
