#pragma once
/// leg_clearance over a box of poses: the distance of two legs lies between that of two points of them, held where they
/// are nearest in the middle of the box, and what every direction gives.

#include "limits/look.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof {

/// The legs of a pair over a box, and their nearest points in its middle.
struct LegPairForms {
  FormEnds one, two;
  Nearest middle;
};
LegPairForms leg_pair_forms(const FormLook& look, int pair);

/// The squared distance of the two points: the legs are not farther apart.
PoseForm squared_distance_above(const LegPairForms& legs);

/// A direction of at most unit length, from the first leg to the second: that of the nearest points in the middle,
/// unknown where the legs meet there; or turning with the legs, so that distances along it differ by the square of
/// the box only, unknown where legs that are nearest between their ends are parallel somewhere in the box.
FormVector fixed_direction(const LegPairForms& legs);
FormVector turning_direction(const LegPairForms& legs);

/// The distances of the four pairs of ends along a direction: at every pose the legs are at least the least of them
/// apart.
struct EndDistances {
  std::array<PoseForm, 4> along;
  std::array<FormVector, 4> between;
};
EndDistances end_distances(const LegPairForms& legs, const FormVector& direction);

}  // namespace ninedof
