#pragma once
/// leg_clearance over a box of poses: the distance of two legs lies between that of two points of them, held where they
/// are nearest in the middle of the box, and what every direction gives.

#include "limits/look.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof {

/// The legs of a pair over a box, and their nearest points in its middle.
template <class T>
struct LegPairOf {
  Ends<T> one, two;
  Nearest middle;
};
using LegPairForms = LegPairOf<PoseForm>;
template <class T, class Robot>
LegPairOf<T> leg_pair_forms(const FormLookOf<T, Robot>& look, int pair);

/// The squared distance of the two points: the legs are not farther apart.
template <class T>
T squared_distance_above(const LegPairOf<T>& legs);

/// A direction of at most unit length, from the first leg to the second: that of the nearest points in the middle,
/// unknown where the legs meet there; or turning with the legs, so that distances along it differ by the square of
/// the box only, unknown where legs that are nearest between their ends are parallel somewhere in the box.
template <class T>
Xyz<T> fixed_direction(const LegPairOf<T>& legs);
template <class T>
Xyz<T> turning_direction(const LegPairOf<T>& legs);

/// The distances of the four pairs of ends along a direction: at every pose the legs are at least the least of them
/// apart.
template <class T>
struct EndDistancesOf {
  std::array<T, 4> along;
  std::array<Xyz<T>, 4> between;
};
using EndDistances = EndDistancesOf<PoseForm>;
template <class T>
EndDistancesOf<T> end_distances(const LegPairOf<T>& legs, const Xyz<T>& direction);

}  // namespace ninedof
