#pragma once
/// Three quadratic functions of three coordinates with bounds of every coefficient: spheres about joints, rotations
/// that fit legs.

#include <optional>

#include "ninedof/math/interval.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

/// value + slope . t + bend . (t1^2, t1 t2, t2^2, t1 t3, t2 t3, t3^2).
struct Quadratic {
  Interval value;
  std::array<Interval, 3> slope;
  std::array<Interval, 6> bend;
};
using Quadratics = std::array<Quadratic, 3>;

/// All values for |t_k| <= reach_k.
Interval range(const Quadratic& f, const Vec3& reach);

/// The equations f = 0 solved for the linear terms, t_i + out_i(t) = 0. None if they depend on each other.
std::optional<Quadratics> solved_for_linear(const Quadratics& f);

/// A double times an interval.
inline Interval times(double x, const Interval& y) {
  const double p = detail::times(x, y.lo), q = detail::times(x, y.hi);
  return {detail::below(std::min(p, q)), detail::above(std::max(p, q))};
}

}  // namespace ninedof
