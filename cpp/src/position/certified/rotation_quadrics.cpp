#include "position/certified/rotation_quadrics.hpp"

namespace ninedof {
namespace {

constexpr double largest_cosine = 1e10;  // a bound beyond it says that O may lie on an external joint

}  // namespace

RotationQuadrics::RotationQuadrics(const Geometry& g, const PointBounds& s, const PointBounds& o,
                                   const Vec3& external_lengths) {
  const Interval one = 1.0, half = 0.5;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Interval l = external_lengths[static_cast<Eigen::Index>(leg)];
    const PointBounds d = bounds_of(g.base_external()[leg]) - s, w = bounds_of(g.platform_external()[leg]) - o;
    const Interval d_norm = norm(d), w_norm = norm(w), difference = d_norm - w_norm;
    const Interval c = one + half * (difference - l) * (difference + l) / (d_norm * w_norm);
    if (c.lo > 1.0 || c.hi < -1.0) impossible_ = true;
    if (!(magnitude(c) < largest_cosine)) known_ = false;
    // Over the lengths of d and w, nearly. A diagonal entry is d . R w - |d||w| c = (l^2 - |d - R w|^2) / 2, R a half
    // turn about an axis, or none: a narrower bound than that of the difference.
    const double over_d = 1.0 / middle(d_norm), over_w = 1.0 / middle(w_norm);
    const auto diagonal = [&](double x, double y, double z) {
      const Interval n = norm(d - PointBounds{times(x, w.x), times(y, w.y), times(z, w.z)});
      return times(over_d, times(over_w, half * (l - n) * (l + n)));
    };
    const PointBounds e = Interval(over_d) * d, f = Interval(over_w) * w, axis = cross(f, e);
    auto& k = k_[leg];
    k[0] = {diagonal(1.0, 1.0, 1.0), axis.x, axis.y, axis.z};
    k[1] = {axis.x, diagonal(1.0, -1.0, -1.0), e.x * f.y + e.y * f.x, e.x * f.z + e.z * f.x};
    k[2] = {axis.y, k[1][2], diagonal(-1.0, 1.0, -1.0), e.y * f.z + e.z * f.y};
    k[3] = {axis.z, k[1][3], k[2][3], diagonal(-1.0, -1.0, 1.0)};
  }
}

Quadratics RotationQuadrics::around(const std::array<double, 4>& centre, std::size_t chart) const {
  const auto free = free_in(chart);
  Quadratics out;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const auto& k = k_[leg];
    std::array<Interval, 4> half_slope;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) half_slope[i] += times(centre[j], k[i][j]);
      out[leg].value += times(centre[i], half_slope[i]);
    }
    for (std::size_t i = 0, n = 0; i < 3; ++i) {
      out[leg].slope[i] = times(2.0, half_slope[free[i]]);
      for (std::size_t j = 0; j < i; ++j) out[leg].bend[n++] = times(2.0, k[free[i]][free[j]]);
      out[leg].bend[n++] = k[free[i]][free[i]];
    }
  }
  return out;
}

}  // namespace ninedof
