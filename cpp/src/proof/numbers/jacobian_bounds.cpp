/// Declared in ninedof/proof/bounds.hpp. J' by the three 3x3 systems of docs/theory/velocity.md, each inverse verified.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "ninedof/proof/bounds.hpp"
#include "proof/numbers/leg_bounds.hpp"

namespace ninedof {
namespace {

using Rows3 = std::array<std::array<Interval, 3>, 3>;

Rows3 rows_of_intervals(const Xyz<Interval>& a, const Xyz<Interval>& b, const Xyz<Interval>& c) {
  return {{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
}

Interval row_times_column(const std::array<Interval, 3>& row, const Rows3& m, std::size_t j) {
  return row[0] * m[0][j] + row[1] * m[1][j] + row[2] * m[2][j];
}

Rows3 product_of(const Rows3& a, const Rows3& b) {
  Rows3 out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = row_times_column(a[i], b, j);
  return out;
}

/// A^-1 = R (A R)^-1 with an approximate inverse R. With |A R - 1| <= z < 1 in the row-sum norm, the second factor
/// differs from 1 by at most z / (1 - z) in each entry. All numbers where z >= 1.
Rows3 inverse_bounds(const Rows3& a) {
  Mat3 about;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      about(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = middle(a[i][j]);
  const Mat3 r = about.inverse();
  Rows3 near, out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) near[i][j] = r(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  double z = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    Interval sum(0.0);
    for (std::size_t j = 0; j < 3; ++j) sum += abs(row_times_column(a[i], near, j) - Interval(i == j ? 1.0 : 0.0));
    z = std::max(z, sum.hi);
  }
  if (!r.allFinite() || !(z < 1.0)) {
    for (auto& row : out) row.fill(Interval::whole());
    return out;
  }
  const double most = (Interval(z) / (1.0 - Interval(z))).hi;
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval around = (abs(near[i][0]) + abs(near[i][1]) + abs(near[i][2])) * Interval(-most, most);
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = near[i][j] + around;
  }
  return out;
}

/// Whether the inverse was verified; its matrix is regular then.
bool verified(const Rows3& inverse) {
  return std::isfinite(magnitude(inverse[0][0]));
}

}  // namespace

std::array<std::array<Interval, 9>, 6> jacobian_bounds(const Geometry& g, const Configuration& c,
                                                       double characteristic_length) {
  require_length("characteristic_length", characteristic_length);
  require_sound_arithmetic();
  const LegBounds k = leg_bounds(g, c);
  const auto unit = [&](std::size_t leg) -> const Xyz<Interval>& { return k.legs[leg].unit; };
  const Rows3 e = rows_of_intervals(unit(0), unit(1), unit(2));
  const Rows3 v = inverse_bounds(rows_of_intervals(unit(3), unit(4), unit(5)));
  const Rows3 s = inverse_bounds(rows_of_intervals(unit(6), unit(7), unit(8)));

  // T omega = ldot - E_e v_O with rows w_i x e_i, and v_O = S rdot - V qdot. T in units of about |w|.
  double size = 0.0;
  for (const Xyz<Interval>& w : k.w) size = std::max({size, magnitude(w.x), magnitude(w.y), magnitude(w.z)});
  const int power = std::isfinite(size) && size > 0.0 ? std::ilogb(size) : 0;
  std::array<Xyz<Interval>, 3> t;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto scaled = [&](const Interval& x) { return times_power_of_two(x, -power); };
    t[i] = cross(Xyz<Interval>{scaled(k.w[i].x), scaled(k.w[i].y), scaled(k.w[i].z)}, unit(i));
  }
  const Rows3 inverse = inverse_bounds(rows_of_intervals(t[0], t[1], t[2]));
  const Rows3 from_upper = product_of(inverse, product_of(e, v)), from_lower = product_of(inverse, product_of(e, s));

  std::array<std::array<Interval, 9>, 6> out;
  if (!(verified(v) && verified(s) && verified(inverse))) {
    for (auto& row : out) row.fill(Interval::whole());
    return out;
  }
  const Interval lc(characteristic_length);
  for (std::size_t j = 0; j < 3; ++j) {
    const auto set = [&](std::size_t column, const Xyz<Interval>& per_size, const Xyz<Interval>& at_o) {
      const auto omega = [&](const Interval& x) { return times_power_of_two(x, -power); };
      const Xyz<Interval> turn = {omega(per_size.x), omega(per_size.y), omega(per_size.z)};
      const Xyz<Interval> pdot = at_o + cross(k.y, turn);
      out[0][column] = lc * turn.x;
      out[1][column] = lc * turn.y;
      out[2][column] = lc * turn.z;
      out[3][column] = pdot.x;
      out[4][column] = pdot.y;
      out[5][column] = pdot.z;
    };
    const Interval none(0.0);
    set(j, {inverse[0][j], inverse[1][j], inverse[2][j]}, {none, none, none});
    set(j + 3, {from_upper[0][j], from_upper[1][j], from_upper[2][j]}, {-v[0][j], -v[1][j], -v[2][j]});
    set(j + 6, {-from_lower[0][j], -from_lower[1][j], -from_lower[2][j]}, {s[0][j], s[1][j], s[2][j]});
  }
  return out;
}

}  // namespace ninedof
