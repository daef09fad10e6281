#pragma once
/// One local minimum from one start that is near it: what the best point of a neighbouring pose is good for.

#include "redundancy/search/search.hpp"

namespace ninedof {

/// The minimum that `start` leads to, in the chamber the merit has entered and `start` lies in. Of at most one element; none
/// where no point near the start keeps the limits.
///
/// A search begins with a soft function, which sends all starts to few ends. Here the softness is no more than the distance to
/// the minimum asks for, so that the start is remembered and few steps are left to go.
Minima nearby_minimum(const Merit& merit, const Vec3& start);

}  // namespace ninedof
