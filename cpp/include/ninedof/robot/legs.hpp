#pragma once
/// Inverse position analysis: the nine legs of a configuration. The solution always exists and is unique.

#include <array>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Lengths, unit vectors and platform lever arms of the nine legs, base frame (eqs. 11-13).
///
/// A leg of zero length has no direction: its unit vector is set to zero, so that every matrix built on it is singular.
struct Legs {
  Vec3 l, q, r;          ///< external, upper internal, lower internal lengths
  Triple e;              ///< external: base joint -> platform joint
  Triple e_tilde;        ///< upper internal: platform joint -> O
  Triple e_hat;          ///< lower internal: base joint -> O
  Triple u, u_tilde;     ///< Q u_i and Q u~_i
};

/// All nine legs.
Legs legs(const Geometry& g, const Configuration& c);

/// l1 l2 l3 q1 q2 q3 r1 r2 r3, the order of eq. (35b).
Vec9 leg_lengths(const Geometry& g, const Configuration& c);

/// Of the longest leg: a leg whose length changes by no more over some poses does not move.
inline constexpr double idle_share = 1e-9;

/// Which legs do not move, from the shortest and the longest length of each over the poses.
std::array<bool, 9> idle_legs(const Vec9& shortest, const Vec9& longest);

}  // namespace ninedof
