#pragma once
/// The closed form of symmetric.hpp for hexagonal designs at theta_z = 0 (eqs. 37-38), all lengths in characteristic lengths.
///
/// Only squares are formed, so that three square roots and two divisions do: with T = g^2 + w^2 + f^2 and d = g w of each block
/// [[g, f], [0, w]], the greater squared singular value is s = (T + sqrt(T^2 - 4 d^2)) / 2 and the lesser d^2 / s.

#include "batch/kernels/pack.hpp"
#include "batch/kernels/table.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

/// Of a block: d^2, s, and whether the difference under the root kept its digits.
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
  constexpr double h = 0.28867513459481288225;  // sqrt(3) / 6
  const P &a1 = x[0], &a2 = x[1], &b1 = x[2], &b2 = x[3], &zp = x[4], &zs = x[5];
  const P rx = 0.5 * a1, ry = -h * (a1 + 2.0 * a2), ux = 0.5 * b1, uy = -h * (b1 + 2.0 * b2);
  const P base2 = square(rx) + square(ry), platform2 = square(ux) + square(uy);
  const P lx = ux - rx, ly = uy - ry, rho = zs - zp;
  const P upper2 = square(rho), lower2 = square(zs);
  const P l2 = square(lx) + square(ly) + square(zp), q2 = platform2 + upper2, r2 = base2 + lower2;
  const P stretch = 1.0 + upper2;

  // One division for four: by l^2 stretch and by what is left of a unit of internal leg speed along and across the axis.
  const P legs = l2 * stretch, along = upper2 * r2 + lower2 * q2, across = platform2 * r2 + base2 * q2;
  const P both = along * across;
  const P inverse = 1.0 / (legs * both);
  const P by_legs = inverse * both, by_internal = inverse * legs;

  const P by_l = by_legs * stretch;
  const P mz = h * (b1 * a2 - a1 * b2);
  const auto axial = squared_block(square(mz) * by_l, square(zp) * by_l, (upper2 * lower2) * (by_internal * across));
  const P vx = uy * zp, vy = -(ux * zp);  // horizontal part of the moment u x (p - r)
  const auto transverse = squared_block((square(vx + rho * ly) + square(vy - rho * lx)) * by_legs,
                                        (square(lx + rho * vy) + square(ly - rho * vx)) * by_legs,
                                        (platform2 * base2) * (by_internal * along) * stretch);

  // The axial block counts 3, the transverse one 3/2.
  const P greatest = max(2.0 * axial.s, transverse.s);
  const P least = max(axial.s * transverse.d2, 2.0 * (transverse.s * axial.d2)) / (2.0 * (axial.d2 * transverse.d2));
  const P ratio = sqrt(greatest * least);
  const auto sure = axial.sure & transverse.sure & (ratio <= 1e12);
  return select(sure, ratio, P(unsure));
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
