#pragma once
/// Where to put O: the internal point that is best for a pose of the platform, or along a path of poses.
///
/// The pose (p, Q) fixes the external legs. O is free: with the platform still (ldot = 0), sdot moves it and takes the internal
/// legs along, qdot = C sdot and rdot = B sdot. Three numbers are therefore left to choose, and this file chooses them.
///
/// O stays in its chamber: det B, det C and det M (the three ways to lose the platform or O) keep the signs they have where the
/// search starts, and O is moved along straight lines on which none of them vanishes. No other chamber is reached.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// What makes an internal point good.
enum class Criterion {
  condition_number,  ///< least condition number of J', eq. (2)
  singularity,  ///< greatest least |det| of three matrices of unit rows: e^_i, e~_i and (r_i - s) x (p + Q u_i - s), both unit
  leg_centring,  ///< least sum of ((length - middle) / half range)^2 over the internal legs; needs finite limits
};

/// Least and greatest lengths, in the order of leg_lengths. Those of l decide whether a pose can be had, the others where O may be.
struct LegLimits {
  Vec9 low = Vec9::Zero();
  Vec9 high = Vec9::Constant(std::numeric_limits<double>::infinity());
};

struct InternalPointProblem {
  Criterion criterion = Criterion::condition_number;
  LegLimits limits;
  double characteristic_length = 1.0;  ///< of the condition number alone
  double clearance =
      1e-10;  ///< each of the three |det| of Criterion::singularity stays above it, whatever the criterion
};

enum class InternalPointStatus : std::uint8_t {
  found,  ///< feasible and stationary by our own checks
  stopped,  ///< feasible, but our checks did not pass: the best point looked at
  infeasible,  ///< an external leg is out of its limits, or no point of the chamber keeps the internal ones; `active` names them
  unbounded,  ///< the criterion keeps improving as O runs away
  singular,  ///< the start lies on a singularity, and so in no chamber
  missing,  ///< the pose has NaN
};

/// "found", "stopped", "infeasible", "unbounded", "singular", "missing".
const char* to_string(InternalPointStatus status);

/// What holds an internal point in place, or what made it impossible: a set of bounds.
class ActiveBounds {
 public:
  static constexpr int count = 21;
  static int low(int leg) { return leg; }
  static int high(int leg) { return 9 + leg; }
  static int clearance(int determinant) { return 18 + determinant; }  ///< of B, C, M

  void add(int bound) { bits_ |= std::uint32_t{1} << bound; }
  bool has(int bound) const { return ((bits_ >> bound) & 1U) != 0; }
  bool empty() const { return bits_ == 0; }
  std::uint32_t bits() const { return bits_; }

  /// "q1 low", "r3 high", "det B".
  std::vector<std::string> names() const;

 private:
  std::uint32_t bits_ = 0;
};

struct InternalPoint {
  Vec3 s = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< NaN unless found or stopped
  double value = std::numeric_limits<double>::quiet_NaN();  ///< of the criterion at s
  InternalPointStatus status = InternalPointStatus::missing;
  ActiveBounds active;
};

/// Throws InvalidArgument naming the limit, the characteristic length or the clearance that makes no sense, or the limits that
/// leg_centring lacks.
void validate(const InternalPointProblem& problem);

/// Midway between the centroids of the lower and of the upper internal joints.
Vec3 default_internal_point(const Geometry& g, const Vec3& position, const Mat3& rotation);

/// The best internal point in the chamber of `start`, by default of default_internal_point.
///
/// A search: local optima are found from many starts and the best is returned. Only `infeasible` for an external leg is a proof.
InternalPoint best_internal_point(const Geometry& g, const Vec3& position, const Mat3& rotation,
                                  const InternalPointProblem& problem, const std::optional<Vec3>& start = {});

}  // namespace ninedof
