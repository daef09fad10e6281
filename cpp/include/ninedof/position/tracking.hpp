#pragma once
/// Direct position analysis for control: follows the assembly mode of a known configuration (docs/theory/position.md).

#include <span>
#include <stop_token>
#include <vector>

#include "ninedof/math/types.hpp"
#include "ninedof/position/trilateration.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

enum class TrackStatus {
  tracked,     ///< reached, and proved to be where the start's mode goes along the straight path of the lengths
  lost,  ///< the mode ends on the path: as far as rounding tells it meets another, or O a plane of internal joints
  infeasible,  ///< the internal legs do not meet, or an external leg is too long or too short for the position of O
  unproved,  ///< none of these is known: too many steps, a plate too small to place O, or a step after one not tracked
};

/// "tracked", "lost", "infeasible", "unproved".
const char* to_string(TrackStatus status);

/// A configuration and its certificate.
struct Tracked {
  TrackStatus status = TrackStatus::unproved;
  Configuration configuration;  ///< NaN unless tracked
  /// Kantorovich's number h = sqrt(3) beta eta of the equations at the end, at the start of the last step. For h <= 1/2
  /// a mode exists near the start and is the only one within `alone_within`. Above, the mode is nearer to the start
  /// than 0.385 times its `separation`, from where Newton's method converges to it. In both cases the bound of h
  /// between the two ends of the step, from its start or from half-way, proves that the mode reached is the continuous
  /// one.
  double certificate;
  /// No second mode with O on the same sides is nearer than this to the start of the last step, rad. NaN if the
  /// certificate is above 1/2.
  double alone_within;
  double separation;  ///< as in AssemblyMode: 0 where two modes meet
  int steps = 0;  ///< number of steps into which the path was divided
  double reached = 0.0;  ///< fraction of the path from the lengths of the start: 1 if tracked

  /// Unproved without a step, as all steps after one that was not tracked.
  static Tracked not_tried();
};

/// Follows one robot. Constructed once, since the planes of the internal joints depend on the geometry only.
class Tracker {
 public:
  explicit Tracker(const Geometry& g);

  /// The mode reached from `start` when the lengths change along a straight path from those of `start` to
  /// `leg_lengths`. O stays on its side of both planes of internal joints and follows in closed form; the rotation
  /// follows by Newton's method. Tracked means proved: no singularity lies on the path, and the mode is the one that
  /// the start's becomes. Where the proof fails the path is divided.
  ///
  /// Throws InvalidArgument for lengths that are negative or not finite.
  Tracked operator()(const Vec9& leg_lengths, const Configuration& start) const;

 private:
  Tracked follow(const Vec9& leg_lengths, const Configuration& start) const;

  int exponent_;  ///< of two: all that follows is in this unit, 1 for robots of ordinary size
  Geometry geometry_;
  SphereCentres base_, platform_;
};

/// One step, or a sequence in which each step starts from the one before. Steps after the first failure are not tried.
/// The sequence throws Stopped on a stop.
Tracked track(const Geometry& g, const Vec9& leg_lengths, const Configuration& start);
std::vector<Tracked> track(const Geometry& g, std::span<const Vec9> leg_lengths, const Configuration& start,
                           const std::stop_token& stop = {});

}  // namespace ninedof
