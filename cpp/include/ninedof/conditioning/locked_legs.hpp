#pragma once
/// The condition number of J' with legs locked at their lengths (docs/failure.md).
///
/// A locked leg has the rate 0: the platform moves with J' without the column of that leg. Any three of the six
/// internal legs may be locked in general: O gives way. An external leg joins base and platform alone: locked, it holds
/// the platform joint on a sphere, and one of the six motions is lost.
///
/// J' without columns K is never formed. Of an orthonormal basis [U; N] of the rates of the internal legs, N the left
/// null space of [C; B] as in conditioning.hpp and U its complement, M J' = [1 0 0; 0 -N], so that
///     J'_K J'_K^T = M^-1 (1 - D D^T) M^-T,  D the columns K of N,
/// and the singular values rho of the rows K of U are those of (1 - D^T D)^1/2. The inverse of each is a factor of M
/// along one direction. For one leg rho is its relative manipulability, sqrt(det(J'_K J'_K^T) / det(J' J'^T)).

#include "ninedof/conditioning/sensitivity.hpp"
#include "ninedof/math/types.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

/// One or two legs, in the order of leg_lengths.
struct LegSet {
  int first;
  int second = -1;  ///< none
  /// How many of the six freedoms of the platform are left.
  int freedoms() const { return 6 - (first < 3 ? 1 : 0) - (0 <= second && second < 3 ? 1 : 0); }
};

/// A pose at which legs may be locked. Throws InvalidArgument unless the characteristic length is finite and positive.
class LockedLegs {
 public:
  LockedLegs(const Points& at, const NineLegs& legs, double characteristic_length);

  /// Of the motions that are left, `locked.freedoms()` of them; infinite where they are fewer. NaN for a pose that has
  /// NaN.
  double condition_number(const LegSet& locked) const;

  /// 0 for an external leg; the squares of the nine add to 3.
  double relative_manipulability(int leg) const;

 private:
  Mat6 m_;
  Mat36 null_, range_;
  bool singular_;  ///< with all legs at work
};

/// Singular values of M with one internal leg locked, descending, and the data for their derivatives. |M t|^2 is least
/// under the condition that the leg has the rate 0; the multiplier of it, the force in the leg, stands in its row of
/// `rates`, and add_spectrum_gradient holds for them too. One is infinite, the rest zero, where the leg alone moves the
/// platform in some direction.
Spectrum locked_spectrum(const Points& at, const NineLegs& legs, double characteristic_length, int leg);

}  // namespace ninedof
