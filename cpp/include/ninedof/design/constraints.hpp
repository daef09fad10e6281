#pragma once
/// Design constraints as signed margins, positive where the design is allowed: relative to their limit, so that 0.01 is
/// one per cent to spare.

#include <limits>
#include <string>
#include <vector>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// What the limits of a constraint measure.
enum class LimitKind {
  ratio,
  length,  ///< see Limit::of
  angle,   ///< radians
  sign,    ///< a determinant of unit vectors
};

/// What a length is a fraction of.
enum class Unit {
  length,  ///< nothing: the study's unit
  zp,      ///< height of the platform
  radius,  ///< largest distance of a joint from z
};

/// low <= named quantity <= high; -infinity (or, for ratios and lengths, 0) and infinity leave a side open.
///
/// What each name means is said in the file of that name in src/constraints. 0 < zs < zp (eq. 9b) holds everywhere
/// without being asked for.
struct Limit {
  std::string name;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  Unit of = Unit::length;
  Vec3 axis =
      Vec3::Zero();  ///< of joint cones, in the body's frame; zero: the leg's direction at the neutral configuration
  int steps = 4;             ///< of singularity_free: parts of the displacement to each pose that are checked

  /// Throws InvalidArgument for an unknown name, a limit that is not a number, low > high, or a side or option the
  /// constraint does not have.
  void validate() const;
};

/// Names of all constraints.
std::vector<std::string> constraint_names();

/// What a constraint's limits measure. Throws InvalidArgument for an unknown name.
LimitKind constraint_kind(const std::string& name);

/// "ratio", "length", "angle" or "sign".
const char* to_string(LimitKind kind);

/// "length", "zp" or "radius"; throws InvalidArgument for another word.
Unit unit_from(const std::string& word);

}  // namespace ninedof
