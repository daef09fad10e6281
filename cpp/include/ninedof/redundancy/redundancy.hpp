#pragma once
/// The best internal point O for a pose of the platform.
///
/// The pose (p, Q) fixes the external legs. O may still move: with the platform at rest (ldot = 0), qdot = C sdot and
/// rdot = B sdot. The three coordinates of O are chosen here.
///
/// The surfaces det B = 0, det C = 0 and det N = 0 (the three kinds of singularity) divide space into chambers. A
/// search stays in the chamber of its start: the three determinants keep their signs, and O moves along straight lines
/// on which none of them vanishes. The robot can therefore reach the result without passing a singularity.

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

/// What is optimised over O.
enum class Criterion {
  condition_number,  ///< least condition number of J', eq. (2)
  singularity,  ///< greatest smallest of |det B|, |det C|, |det N|, the determinants of singularity.hpp
  leg_centring,  ///< least sum of ((length - middle) / half range)^2 over the internal legs; needs finite limits
};

/// Least and greatest lengths, in the order of leg_lengths. Those of l decide whether a pose is possible, the others
/// where O may be.
struct LegLimits {
  Vec9 low = Vec9::Zero();
  Vec9 high = Vec9::Constant(std::numeric_limits<double>::infinity());
};

struct InternalPointProblem {
  Criterion criterion = Criterion::condition_number;
  LegLimits limits;
  double characteristic_length = 1.0;  ///< of the condition number alone
  double clearance = 1e-10;  ///< lower bound of each |det| of Criterion::singularity, for every criterion
};

enum class InternalPointStatus : std::uint8_t {
  found,  ///< within the limits, stationary by independent checks, and no worse than any point of a scan of the chamber
  local,  ///< within the limits and stationary, but the scan saw more cells that may be lower than it divided
  stopped,  ///< within the limits, but the checks failed: the best point evaluated
  /// An external leg is out of its limits, or no point of the chamber keeps the internal ones; `active` names them.
  infeasible,
  unbounded,  ///< the criterion improves as O moves away or into a joint, where no point attains its limit
  singular,  ///< the start lies on a singularity, and so in no chamber; one within the clearance does not
  missing,  ///< the pose has NaN
};

/// "found", "local", "stopped", "infeasible", "unbounded", "singular", "missing".
const char* to_string(InternalPointStatus status);

/// A set of bounds: those that hold an internal point in place, or that leave none.
class ActiveBounds {
 public:
  static constexpr int count = 21;
  static int low(int leg) { return leg; }
  static int high(int leg) { return 9 + leg; }
  static int clearance(int determinant) { return 18 + determinant; }  ///< of B, C, N

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

/// Throws InvalidArgument naming the limit, the characteristic length or the clearance that is not valid, or the limits
/// that leg_centring lacks.
void validate(const InternalPointProblem& problem);

/// Midway between the centroids of the lower and of the upper internal joints.
Vec3 default_internal_point(const Geometry& g, const Vec3& position, const Mat3& rotation);

/// The best internal point in the chamber of `start`, by default of default_internal_point.
///
/// A multi-start search with a scan of the chamber: the best of the local optima found, and no worse than a start that
/// the limits allow. Only `infeasible` for an external leg is proved.
InternalPoint best_internal_point(const Geometry& g, const Vec3& position, const Mat3& rotation,
                                  const InternalPointProblem& problem, const std::optional<Vec3>& start = {});

}  // namespace ninedof
