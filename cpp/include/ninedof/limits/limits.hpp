#pragma once
/// Limits: what a design, a pose or all poses together have to keep. Their margins are positive where they are kept,
/// and relative to the limit: 0.01 is one per cent to spare.

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ninedof/limits/duty.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

/// A limit that is passed by no more than this part of it counts as kept: between the poses that were looked at, a
/// design of the optimizer passes its limits by up to 1e-7.
inline constexpr double margin_tolerance = 1e-6;

/// What the limits of a constraint measure.
enum class LimitKind {
  ratio,
  length,  ///< see Limit::of
  angle,   ///< radians
  sign,    ///< a determinant of singularity.hpp, in [-1, 1]
  number,  ///< in units of the study that are no lengths: forces
  rate,    ///< a length over time
  power,   ///< a force times a rate
};

/// What a length is a fraction of.
enum class Unit {
  length,  ///< nothing: the study's unit
  zp,      ///< height of the platform
  radius,  ///< largest distance of a joint from z
};

/// Where a limit holds.
enum class LimitAt {
  poses,    ///< at every pose of the objective, or at the neutral one if it has none
  neutral,  ///< at the neutral pose alone
};

/// What a limit at a pose is about besides the pose.
struct LimitOptions {
  /// Of joint cones, in the body's frame, that of geometries; zero: the leg's direction at the neutral configuration.
  Vec3 axis = Vec3::Zero();
  /// Of forces, rates and powers of legs; null for other limits.
  std::shared_ptr<const Duty> duty = nullptr;

  LimitOptions() = default;
  LimitOptions(const Vec3& given, std::shared_ptr<const Duty> machine = nullptr)  // NOLINT: most have an axis alone
      : axis(given), duty(std::move(machine)) {}
  bool operator==(const LimitOptions&) const = default;
};

/// low <= named quantity <= high; -infinity (or, for ratios and lengths, 0) and infinity leave a side open.
///
/// What each name means is said in src/limits, see the table there. 0 < zs < zp (eq. 9b) always holds.
struct Limit {
  std::string name;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  Unit of = Unit::length;
  /// Of joint cones, in the body's frame, that of geometries; zero: the leg's direction at the neutral configuration.
  Vec3 axis = Vec3::Zero();
  /// Of singularity_free: parts of the way to each pose that are tested, 1 to most_steps; none at the neutral pose.
  int steps = 4;
  static constexpr int most_steps = 1000;
  /// A limit of the design alone, such as radius_ratio, is the same at either.
  LimitAt at = LimitAt::poses;
  /// Of forces, rates and powers, as in LimitOptions.
  std::shared_ptr<const Duty> duty = nullptr;

  LimitOptions options() const { return {axis, duty}; }

  /// What margins, prices and messages call it: its name, followed by " at neutral" for the neutral pose alone.
  std::string label() const;

  /// Throws InvalidArgument for an unknown name, a limit that is not a number, low > high, or a side or option the
  /// constraint does not have, or none where it needs it; at the neutral pose also for what compares poses: strokes,
  /// and cones without an axis.
  void validate() const;
};

/// The side of a limit that a margin belongs to.
enum class Side { high, low };

/// What a value leaves of a limit as people read it, negative where the limit is violated: a share of the limit; of a
/// determinant, which has no scale, value - limit or limit - value. Infinite of an open side.
double margin(LimitKind kind, Side side, double limit, double value);

/// The sides that a limit can have.
enum class LimitSides { both, only_low, only_high };

/// A row of the table of constraints and of the criteria of workspaces.
struct ConstraintInfo {
  const char* name;
  LimitKind kind;
  LimitSides sides;
  Unit of = Unit::length;    ///< the unit it takes besides "length", if another
  const char* option = "";   ///< "axis", "radius" or "steps"; what else a study file may say of it
  double default_low = 0.0;  ///< its low side where none is given
  bool compares_poses = false;  ///< it has no value at a single pose
  const char* needs = "";       ///< what of Limit::duty it is about: "loads", "speeds" or "loads speeds"
};

/// The constraints of designs.
std::vector<ConstraintInfo> constraint_table();

/// The criteria of workspaces, in the order of limit_names().
std::vector<ConstraintInfo> criterion_table();

/// "ratio", "length", "angle", "sign", "number", "rate" or "power".
const char* to_string(LimitKind kind);

/// Of the same word; throws InvalidArgument for another.
LimitKind limit_kind_from(const std::string& word);

/// "length", "zp" or "radius".
const char* to_string(Unit unit);

}  // namespace ninedof
