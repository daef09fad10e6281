#pragma once
/// Closed form of the singular values on the symmetry axis, for any C3 design.
///
/// If the four joint triples are orbits of a rotation by 120 degrees about z, and p and s lie on z, the matrix M of
/// conditioning.hpp splits into a 2x2 block for (omega_z, p_z) and a complex 2x2 block, occurring twice, for the
/// transverse motion. Because E t = C v_O (v_O: velocity of the platform point at O), a rotation of the columns makes
/// both blocks triangular, [[g, f], [0, w]], and their singular values follow without cancellation
/// (docs/theory/closed-form.md).
///
/// A template over the number type: T = double for values, T = Dual<N> for exact gradients. Shares no code with
/// velocity.hpp: the tests check each against the other.

#include <cmath>

#include "ninedof/math/dual.hpp"
#include "ninedof/math/xyz.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// The first joint of each orbit in base axes, the platform joints as Q u_1 and Q u~_1, and the heights of p and s.
template <class T>
struct AxisDesign {
  Xyz<T> base_external, base_internal, platform_external, platform_internal;
  T zp, zs;
};

/// The four distinct singular values of M (reciprocals of those of J') and the three distinct leg lengths.
/// The axial pair occurs once, the transverse pair twice.
template <class T>
struct AxisSpectrum {
  T axial_max, axial_min, transverse_max, transverse_min;
  T l, q, r;
};

namespace detail {

/// 1 / length. Zero for a leg of zero length, whose direction then becomes zero and the design singular, as in
/// legs.hpp.
template <class T>
T inverse_or_zero(const T& length) {
  return value_of(length) == 0.0 ? T(0.0) : 1.0 / length;
}

template <class T>
struct Pair {
  T max, min;
};

/// Singular values of [[g, f], [0, w]] times `scale`, from |g|, |f|^2 and |w|.
template <class T, class Scale>
Pair<T> triangular_block(const T& g, const T& f_squared, const T& w, const Scale& scale) {
  using std::sqrt;
  const T sum = sqrt(square(g + w) + f_squared) + sqrt(square(g - w) + f_squared);  // 2 sigma_max
  if (!(value_of(sum) != 0.0)) return {sum, sum};
  return {scale * 0.5 * sum, scale * 2.0 * (g * w) / sum};
}

/// (a/q) (b/r) / hypot(a/q, b/r) with one division: the singular value of a direction in which an upper internal leg of
/// length q has the component a >= 0 and a lower one of length r the component b >= 0.
template <class T>
T shared(const T& a, const T& q, const T& b, const T& r) {
  using std::sqrt;
  const T n = sqrt(square(a * r) + square(b * q));
  return value_of(n) == 0.0 ? n : a * b / n;
}

}  // namespace detail

/// The closed form. Lengths in one unit. The characteristic length, a double or a T, must be positive; it is not
/// checked.
template <class T, class Length>
AxisSpectrum<T> axis_spectrum(const AxisDesign<T>& d, const Length& characteristic_length) {
  using detail::shared;
  using std::abs;
  using std::sqrt;
  using Plain = PlainNumber<T>;  // over intervals the factors of the blocks are enclosed too
  const Length inverse_lc = 1.0 / characteristic_length;

  // External leg 1: x = (p - r) + u. Its moment u x x / (l l_c) is formed as u x (p - r) / (l l_c).
  // By components: temporary vectors of dual numbers cost 5 to 13 percent.
  const Xyz<T>& u = d.platform_external;
  const T px = -d.base_external.x, py = -d.base_external.y, pz = d.zp - d.base_external.z;
  const T x = px + u.x, y = py + u.y, z = pz + u.z;
  const T l = sqrt(square(x) + square(y) + square(z));
  const T inverse_l = detail::inverse_or_zero(l);
  const T ex = x * inverse_l, ey = y * inverse_l, ez = z * inverse_l;
  const T lever = inverse_lc * inverse_l;
  const T mx = (u.y * pz - u.z * py) * lever;
  const T my = (u.z * px - u.x * pz) * lever;
  const T mz = (u.x * py - u.y * px) * lever;

  // Internal legs 1: only their axial and radial components matter.
  const T rho = d.zs - d.zp;
  const T upper_z = rho - d.platform_internal.z;
  const T lower_z = d.zs - d.base_internal.z;
  const T upper_radius2 = square(d.platform_internal.x) + square(d.platform_internal.y);
  const T lower_radius2 = square(d.base_internal.x) + square(d.base_internal.y);
  const T q = sqrt(upper_radius2 + square(upper_z));
  const T r = sqrt(lower_radius2 + square(lower_z));

  const T axial_w = shared(abs(upper_z), q, abs(lower_z), r);
  const detail::Pair<T> axial = detail::triangular_block(abs(mz), square(ez), axial_w, sqrt(Plain(3.0)));

  const T eta = rho * inverse_lc;
  const T stretch2 = 1.0 + square(eta);
  const T stretch = sqrt(stretch2);
  const T g = sqrt(square(mx + eta * ey) + square(my - eta * ex)) / stretch;
  const T f_squared = (square(ex + eta * my) + square(ey - eta * mx)) / stretch2;
  const T w = shared(sqrt(upper_radius2), q, sqrt(lower_radius2), r) * stretch;
  const detail::Pair<T> transverse = detail::triangular_block(g, f_squared, w, sqrt(Plain(1.5)));

  return {axial.max, axial.min, transverse.max, transverse.min, l, q, r};
}

/// The axis design of a geometry and configuration. Throws InvalidArgument naming what violates the symmetry: a triple
/// that is not a C3 orbit about z (to 1e-9 of its size), p or s off the z axis, or a rotation about another axis.
AxisDesign<double> axis_design(const Geometry& g, const Configuration& c);

}  // namespace ninedof
