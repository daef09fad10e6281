#pragma once
/// The singular values on the symmetry axis of planar threefold designs, through seven numbers (docs/theory/proof.md).
///
/// U, R: distance of the external joints of platform and base from the axis; theta: the angle between the first two, of
/// which c and sine are taken; the internal joints count by their distances alone. Hexagons need five numbers: y = x
/// and z = 1.
///
/// Shares no code with conditioning/symmetric.hpp: the tests check each against the other.

#include <array>
#include <cstddef>
#include <optional>

#include "ninedof/conditioning/characteristic_length.hpp"
#include "ninedof/math/interval.hpp"

namespace ninedof::proof {

/// The coordinates of a box of designs, all positive: what follows is said along their logarithms.
enum Coordinate : std::size_t {
  at_size,    ///< U / l_c
  at_ratio,   ///< x = R / U
  at_height,  ///< eta = zp / U
  at_share,   ///< o = zs / (zp - zs)
  at_angle,   ///< tau = tan(theta / 2)
  at_lower,   ///< y = distance of the internal base joints from the axis / U
  at_upper,   ///< z = the same of the internal platform joints / U
};
inline constexpr std::size_t coordinates = 7, hexagonal_coordinates = 5;

/// What the coordinates of a box are.
struct Chart {
  std::size_t dimension = coordinates;  ///< the first ones, which are cut
  /// 1 + t, y/t and z/q in the places of o, y and z: finite where radii of internal joints begin at 0.
  bool slopes = false;
  std::optional<LengthKind> length;  ///< U / l_c follows from the other coordinates, by the definition of l_c

  bool hexagonal() const { return dimension == hexagonal_coordinates; }
};

/// [[g, f], [0, w]] by the squares of its entries, none negative.
template <class T>
struct Block {
  T g2, f2, w2;
};

/// The two blocks of M, the squares of the three leg lengths in units of U, and the parts they are made of.
template <class T>
struct AxisPieces {
  Block<T> axial, transverse;
  T external2, upper2, lower2;

  T cosine, sine2;  ///< c and 1 - c^2
  T plan2;          ///< n = (x - 1)^2 + 2 x (1 - c): horizontal part of the external leg, squared
  T t, q;           ///< zs / zp and 1 - zs / zp
  T upper_flat2;    ///< (z / (q eta))^2: horizontal over vertical part of an upper leg, squared
  T lower_flat2;    ///< (y / (t eta))^2
  T axial_share;    ///< W0 = 1 / (2 + upper_flat2 + lower_flat2)
  T radial_share;   ///< W1 = 1 / (2 + 1 / upper_flat2 + 1 / lower_flat2)
  T lever2;         ///< (q eta U)^2
  T arm2;           ///< h^2 = (t + q x c)^2 + q^2 x^2 (1 - c^2)
  T offset, slant2; ///< P = 1 - c x + q eta^2 U^2 and F = P^2 + x^2 (1 - c^2)
};

inline double squared(double x) {
  return x * x;
}
inline double not_negative(double x) {
  return std::max(x, 0.0);
}
inline Interval not_negative(const Interval& x) {
  return {std::max(x.lo, 0.0), std::max(x.hi, 0.0)};
}
inline Interval squared(const Interval& x) {
  return square(x);
}

/// sin^2 theta = 4 / (tau + 1/tau)^2, which grows up to tau = 1 and falls from there.
inline double sine_squared(double tau) {
  return squared(2.0 / (tau + 1.0 / tau));
}
inline Interval sine_squared(const Interval& tau) {
  const auto at = [](double t) { return square(2.0 / (Interval(t) + 1.0 / Interval(t))); };
  const Interval a = at(tau.lo), b = at(tau.hi);
  return {std::min(a.lo, b.lo), contains(tau, 1.0) ? 1.0 : std::min(std::max(a.hi, b.hi), 1.0)};
}

template <class T>
AxisPieces<T> axis_pieces(const std::array<T, coordinates>& at, const Chart& chart = {}) {
  const T &U = at[at_size], &x = at[at_ratio], &eta = at[at_height], &o = at[at_share], &tau = at[at_angle];
  const T &y = at[at_lower], &z = at[at_upper];
  AxisPieces<T> p;
  const T versed = 2.0 / (1.0 + 1.0 / squared(tau));  // 1 - c
  const T& c = p.cosine = 1.0 - versed;
  p.sine2 = sine_squared(tau);
  const T x2 = squared(x), U2 = squared(U), eta2 = squared(eta);
  p.q = chart.slopes ? not_negative(2.0 - o) : 1.0 / (1.0 + o);
  p.t = chart.slopes ? not_negative(o - 1.0) : 1.0 / (1.0 + 1.0 / o);
  p.plan2 = squared(x - 1.0) + 2.0 * x * versed;
  const T upper_up2 = squared(p.q * eta), lower_up2 = squared(p.t * eta);
  p.external2 = p.plan2 + eta2;
  p.upper2 = chart.slopes ? squared(p.q) * (squared(z) + eta2) : squared(z) + upper_up2;
  p.lower2 = chart.slopes ? squared(p.t) * (squared(y) + eta2) : squared(y) + lower_up2;

  p.upper_flat2 = squared(z) / (chart.slopes ? eta2 : upper_up2);
  p.lower_flat2 = squared(y) / (chart.slopes ? eta2 : lower_up2);
  p.axial_share = 1.0 / (2.0 + p.upper_flat2 + p.lower_flat2);
  p.axial = {3.0 * U2 * p.sine2 / (squared(1.0 - c / x) + (p.sine2 + eta2) / x2), 3.0 / (1.0 + p.plan2 / eta2),
             3.0 * p.axial_share};

  p.lever2 = upper_up2 * U2;
  const T stretch2 = 1.0 + p.lever2;
  p.radial_share = 1.0 / (2.0 + 1.0 / p.upper_flat2 + 1.0 / p.lower_flat2);
  p.arm2 = squared(p.t + p.q * x * c) + squared(p.q * x) * p.sine2;
  p.offset = 1.0 - c * x + p.q * eta2 * U2;
  p.slant2 = squared(p.offset) + x2 * p.sine2;
  p.transverse = {1.5 * p.arm2 / ((1.0 + p.plan2 / eta2) * (1.0 / U2 + upper_up2)),
                  1.5 * p.slant2 / (p.external2 * stretch2), 1.5 * stretch2 * p.radial_share};
  return p;
}

}  // namespace ninedof::proof
