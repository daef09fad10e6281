#pragma once
/// Reference: the Gough-Stewart platform on the same joints, with legs r_i-u_i and r^_i-u~_i, on the symmetry axis.
///
/// Its matrix H has the six rows [u x e / l_c, e], and J' is its inverse, so kappa(J') = kappa(H). C3 symmetry splits H
/// into an axial 2x2 block and a complex transverse 2x2 block that occurs twice (docs/theory/closed-form.md).

#include "ninedof/conditioning/symmetric.hpp"

namespace ninedof {

/// Singular values of H: the axial pair occurs once, the transverse pair twice.
template <class T>
struct HexapodSpectrum {
  T axial_max, axial_min, transverse_max, transverse_min;
};

namespace detail {

/// One leg's direction e and moment u x e / l_c.
template <class T>
struct LegRow {
  Xyz<T> e, m;
};

/// The leg is formed as (p + u) - r, for non-planar designs one rounding away from the (p - r) + u of axis_spectrum.
template <class T, class Length>
LegRow<T> leg_row(const Xyz<T>& base, const Xyz<T>& joint, const T& zp, const Length& inverse_lc) {
  using std::sqrt;
  const Xyz<T>& u = joint;
  const T x = u.x - base.x, y = u.y - base.y, z = zp + u.z - base.z;
  const T inverse = inverse_or_zero(T(sqrt(square(x) + square(y) + square(z))));
  const Xyz<T> e{x * inverse, y * inverse, z * inverse};
  return {e,
          {(u.y * e.z - u.z * e.y) * inverse_lc, (u.z * e.x - u.x * e.z) * inverse_lc,
           (u.x * e.y - u.y * e.x) * inverse_lc}};
}

/// Singular values from T, the squared Frobenius norm, and the determinant D: their sum and difference are the square
/// roots of `plus` = T + 2 D and of `minus` = T - 2 D, computed without cancellation.
template <class T>
Pair<T> from_sums(const T& plus, const T& minus, const T& determinant, double scale) {
  using std::sqrt;
  const T largest = 0.5 * (sqrt(plus) + sqrt(minus));
  if (!(value_of(largest) != 0.0)) return {largest, largest};
  return {scale * largest, scale * (determinant / largest)};
}

}  // namespace detail

/// The closed form, with the conventions of axis_spectrum.
template <class T, class Length>
HexapodSpectrum<T> hexapod_spectrum(const AxisDesign<T>& d, const Length& characteristic_length) {
  using std::abs;
  using std::sqrt;
  const Length inverse_lc = 1.0 / characteristic_length;
  const auto a = detail::leg_row(d.base_external, d.platform_external, d.zp, inverse_lc);
  const auto b = detail::leg_row(d.base_internal, d.platform_internal, d.zp, inverse_lc);

  // Axial block [[m, e], [n, f]]: (m + f)^2 + (e - n)^2 = |.|^2 + 2 det, and with the other signs |.|^2 - 2 det.
  const T det0 = a.m.z * b.e.z - a.e.z * b.m.z;
  const T p0 = square(a.m.z + b.e.z) + square(a.e.z - b.m.z), q0 = square(a.m.z - b.e.z) + square(a.e.z + b.m.z);
  const bool up = value_of(det0) >= 0.0;
  const detail::Pair<T> axial = detail::from_sums(up ? p0 : q0, up ? q0 : p0, T(abs(det0)), std::sqrt(3.0));

  // Transverse block [[m, e], [n, f]] of complex numbers w_x + i w_y. A phase makes the determinant real and positive:
  // with det = D exp(i t) take m, e times exp(-i t).
  const T re = a.m.x * b.e.x - a.m.y * b.e.y - a.e.x * b.m.x + a.e.y * b.m.y;
  const T im = a.m.x * b.e.y + a.m.y * b.e.x - a.e.x * b.m.y - a.e.y * b.m.x;
  const T det1 = sqrt(square(re) + square(im));
  const T inverse = detail::inverse_or_zero(det1);
  const T c = re * inverse, s = im * inverse;
  const T mx = a.m.x * c + a.m.y * s, my = a.m.y * c - a.m.x * s;
  const T ex = a.e.x * c + a.e.y * s, ey = a.e.y * c - a.e.x * s;
  // |m + conj f|^2 + |e - conj n|^2 = |.|^2 + 2 Re det, and with the other signs |.|^2 - 2 Re det.
  const T plus = square(mx + b.e.x) + square(my - b.e.y) + square(ex - b.m.x) + square(ey + b.m.y);
  const T minus = square(mx - b.e.x) + square(my + b.e.y) + square(ex + b.m.x) + square(ey - b.m.y);
  const detail::Pair<T> transverse = detail::from_sums(plus, minus, det1, std::sqrt(1.5));
  return {axial.max, axial.min, transverse.max, transverse.min};
}

}  // namespace ninedof
