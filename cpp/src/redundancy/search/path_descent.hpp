#pragma once
/// Newton's method on the internal points of a whole path.

#include <span>
#include <stop_token>
#include <vector>

#include "redundancy/search/merit.hpp"

namespace ninedof {

/// One pose of a path: what is minimised there, and O in the coordinates of its scene.
struct Stop {
  const Merit* merit;
  Vec3 x;
};

/// Minimises sum f_k(x_k) + coupling sum |s_(k+1) - s_k|^2, s in lengths, over all points at once, from points inside their chambers
/// and limits. The Hessian is block tridiagonal: a step costs what its poses cost. Throws Stopped on a stop. False if it did not settle.
bool settle_path(std::span<Stop> stops, double coupling, const std::stop_token& stop);

}  // namespace ninedof
