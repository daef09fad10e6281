#pragma once
/// The joints of a semi-regular hexagon with alternating sides s1, s2, as printed in eqs. (37)-(38), over a number
/// type.
///
/// External joints 1, 2, 3 are given here. The internal triple is the mirror image of the external one in x = 0:
/// internal joints 1, 2, 3 are the mirrored external joints 1, 3, 2. Included by the batch kernels, hence templates
/// only.

#include "ninedof/math/xyz.hpp"

namespace ninedof {

inline constexpr double sqrt3_over_6 = 0.28867513459481288225;

template <class T>
[[gnu::always_inline]] inline Xyz<T> hexagon_joint_1(const T& s1, const T& s2) {
  return {0.5 * s1, -sqrt3_over_6 * (s1 + 2.0 * s2), T(0.0)};
}
template <class T>
[[gnu::always_inline]] inline Xyz<T> hexagon_joint_2(const T& s1, const T& s2) {
  return {-0.5 * (s1 + s2), -sqrt3_over_6 * (s1 - s2), T(0.0)};
}
template <class T>
[[gnu::always_inline]] inline Xyz<T> hexagon_joint_3(const T& s1, const T& s2) {
  return {0.5 * s2, sqrt3_over_6 * (2.0 * s1 + s2), T(0.0)};
}
/// The mirror image in the plane x = 0.
template <class T>
[[gnu::always_inline]] inline Xyz<T> mirrored(const Xyz<T>& joint) {
  return {-joint.x, joint.y, joint.z};
}

}  // namespace ninedof
