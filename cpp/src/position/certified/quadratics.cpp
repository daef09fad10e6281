#include "position/certified/quadratics.hpp"

#include <Eigen/LU>

namespace ninedof {

Interval range(const Quadratic& f, const Vec3& reach) {
  using detail::above;
  Interval out = f.value;
  for (std::size_t i = 0, n = 0; i < 3; ++i) {
    const double r = reach[static_cast<Eigen::Index>(i)], most = above(magnitude(f.slope[i]) * r);
    out += Interval(-most, most);
    for (std::size_t j = 0; j < i; ++j, ++n) {
      const double bent = above(magnitude(f.bend[n]) * above(r * reach[static_cast<Eigen::Index>(j)]));
      out += Interval(-bent, bent);
    }
    out += f.bend[n++] * Interval(0.0, above(r * r));
  }
  return out;
}

std::optional<Quadratics> solved_for_linear(const Quadratics& f) {
  Mat3 slopes;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      slopes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = middle(f[i].slope[j]);
  const Mat3 inverse = slopes.inverse();
  if (!inverse.allFinite()) return {};
  Quadratics out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double factor = inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
      out[i].value += times(factor, f[k].value);
      for (std::size_t j = 0; j < 3; ++j) out[i].slope[j] += times(factor, f[k].slope[j]);
      for (std::size_t n = 0; n < 6; ++n) out[i].bend[n] += times(factor, f[k].bend[n]);
    }
    out[i].slope[i] -= 1.0;
  }
  return out;
}

}  // namespace ninedof
