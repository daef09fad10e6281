#include "singularity/unit_rows.hpp"

#include <Eigen/LU>
#include <cmath>

#include "math/linear/jacobi_svd.hpp"
#include "math/numbers.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

/// A difference of points shorter than this many roundings of their coordinates has no direction.
constexpr double roundings_of_zero = 4.0;

/// `size`: how large the coordinates were that the vector is a difference of.
Span span(double length, const Vec3& direction, double size) {
  return length <= roundings_of_zero * eps * size ? Span{} : Span{length, direction};
}
Span span(const Vec3& v, double size) {
  const double length = v.norm();
  return length == 0.0 ? Span{} : span(length, v / length, size);
}

}  // namespace

Spans spans(const Geometry& g, const Configuration& c) {
  const Legs k = legs(g, c);
  const Vec3 &p = c.position, &s = c.internal_point;
  const double p_size = p.norm(), s_size = s.norm();
  Spans out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Vec3& r = g.base_external()[i];
    const double r_size = r.norm(), head = p_size + k.u[i].norm();
    out.d[i] = span(r - s, r_size + s_size);
    out.w[i] = span(p + k.u[i] - s, head + s_size);
    out.external[i] = span(k.l[row], k.e[i], head + r_size);
    out.upper[i] = span(k.q[row], k.e_tilde[i], s_size + p_size + k.u_tilde[i].norm());
    out.lower[i] = span(k.r[row], k.e_hat[i], s_size + g.base_internal()[i].norm());
  }
  return out;
}

UnitRows unit_rows(const Spans& k) {
  UnitVectors v;
  for (std::size_t i = 0; i < 3; ++i) {
    v.d[i] = k.external[i].length == 0.0 ? Vec3(Vec3::Zero()) : k.d[i].direction;
    v.w[i] = k.w[i].direction;
    v.e_tilde[i] = k.upper[i].direction;
    v.e_hat[i] = k.lower[i].direction;
  }
  return unit_rows(v);
}

bool regular(const Mat3& rows) {
  if (!rows.allFinite()) return false;
  // |det| is the product of the singular values, of which two are at most |rows|: mostly this decides.
  const double size = rows.norm();
  if (std::abs(rows.determinant()) > 2.0 * negligible * size * size * size) return true;
  const Vec3 sigma = jacobi_svd(rows).sigma;
  return sigma[2] > negligible * sigma[0];
}

std::array<int, 3> sides(const UnitRows& rows) {
  const auto side = [](const Triple& t) { return !regular(rows_of(t)) ? 0 : determinant(t) > 0.0 ? 1 : -1; };
  return {side(rows.n), side(rows.b), side(rows.c)};
}

}  // namespace ninedof
