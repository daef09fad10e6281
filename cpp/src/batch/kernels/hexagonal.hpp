#pragma once
/// The closed form of symmetric.hpp for hexagonal designs at theta_z = 0 (eqs. 37-38), all lengths in units of the
/// characteristic length (docs/theory/closed-form.md).
///
/// Only squares are formed, so that three square roots and two divisions suffice: with T = g^2 + w^2 + f^2 and d = g w
/// of each block [[g, f], [0, w]], the greater squared singular value is s = (T + sqrt(T^2 - 4 d^2)) / 2 and the
/// smaller one d^2 / s.

#include "batch/kernels/pack.hpp"
#include "batch/kernels/table.hpp"
#include "ninedof/robot/hexagon.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

/// d^2 and s of a block, and whether the difference under the root has lost no digits.
template <class P>
struct SquaredBlock {
  P d2, s;
  typename P::Mask sure;
};

template <class P>
NINEDOF_INLINE SquaredBlock<P> squared_block(const P& g2, const P& f2, const P& w2) {
  const P t = g2 + w2 + f2, d2 = g2 * w2;
  const P under = square(t) - 4.0 * d2;
  return {d2, 0.5 * (t + sqrt(max(under, P(0.0)))), under >= 1e-4 * square(t)};
}

/// Condition number of the design a1 a2 b1 b2 zp zs.
template <class P>
NINEDOF_INLINE P hexagonal_condition(const P (&x)[6]) {
  const P &a1 = x[0], &a2 = x[1], &b1 = x[2], &b2 = x[3], &zp = x[4], &zs = x[5];
  const Xyz<P> r = hexagon_joint_1(a1, a2), u = hexagon_joint_1(b1, b2);
  const P base2 = square(r.x) + square(r.y), platform2 = square(u.x) + square(u.y);
  const P lx = u.x - r.x, ly = u.y - r.y, rho = zs - zp;
  const P upper2 = square(rho), lower2 = square(zs);
  const P l2 = square(lx) + square(ly) + square(zp), q2 = platform2 + upper2, r2 = base2 + lower2;
  const P stretch = 1.0 + upper2;

  // One division in place of four: by l^2 stretch, and by the denominators of the internal legs along and across z.
  const P legs = l2 * stretch, along = upper2 * r2 + lower2 * q2, across = platform2 * r2 + base2 * q2;
  const P both = along * across;
  const P inverse = 1.0 / (legs * both);
  const P by_legs = inverse * both, by_internal = inverse * legs;

  const P by_l = by_legs * stretch;
  const P mz = sqrt3_over_6 * (b1 * a2 - a1 * b2);
  const auto axial = squared_block(square(mz) * by_l, square(zp) * by_l, (upper2 * lower2) * (by_internal * across));
  const P vx = u.y * zp, vy = -(u.x * zp);  // horizontal part of the moment u x (p - r)
  const auto transverse = squared_block((square(vx + rho * ly) + square(vy - rho * lx)) * by_legs,
                                        (square(lx + rho * vy) + square(ly - rho * vx)) * by_legs,
                                        (platform2 * base2) * (by_internal * along) * stretch);

  // The squared singular values have the factor 3 in the axial block, 3/2 in the transverse one.
  const P greatest = max(2.0 * axial.s, transverse.s);
  const P least = max(axial.s * transverse.d2, 2.0 * (transverse.s * axial.d2)) / (2.0 * (axial.d2 * transverse.d2));
  const P ratio = sqrt(greatest * least);
  const auto sure = axial.sure & transverse.sure & (ratio <= 1e12);
  return select(sure, ratio, P(unsure));
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
