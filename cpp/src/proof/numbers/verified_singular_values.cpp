#include "proof/numbers/verified_singular_values.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "math/linear/jacobi_svd.hpp"
#include "proof/numbers/matrix_ball.hpp"

namespace ninedof {

std::array<Interval, 6> verified_singular_values(const Mat6& m, double radius) {
  using detail::above, detail::below;
  std::array<Interval, 6> out;
  out.fill({0.0, detail::no_bound});
  const Svd<6> svd = jacobi_svd(m);
  if (!svd.sigma.allFinite() || !std::isfinite(radius)) return out;
  const Mat6 ut = svd.u.transpose(), vt = svd.v.transpose();
  const double alpha = distance_from_identity(ut, svd.u), beta = distance_from_identity(vt, svd.v);
  if (!(alpha < 0.5 && beta < 0.5)) return out;

  // U^T M V = diag(d) + rest.
  const MatrixBall<6, 6> mv = exact_product(m, svd.v), umv = exact_product(ut, mv.middle);
  Vec6 d = umv.middle.diagonal().cwiseAbs();
  Mat6 off = umv.middle;
  off.diagonal().setZero();
  const Interval a(alpha), b(beta);
  const Interval rest = Interval(norm_above(off)) + umv.radius() + sqrt(1.0 + a) * mv.radius();
  const Interval least_stretch = sqrt((1.0 - a) * (1.0 - b)), most_stretch = sqrt((1.0 + a) * (1.0 + b));
  std::sort(d.begin(), d.end(), std::greater<>());
  for (std::size_t k = 0; k < 6; ++k) {
    const Interval near = Interval(d[static_cast<Eigen::Index>(k)]);
    const double lo = ((near - rest) / most_stretch - radius).lo;
    out[k] = {std::max(lo, 0.0), ((near + rest) / least_stretch + radius).hi};
  }
  return out;
}

double least_singular_value(const Eigen::Matrix<double, 6, 3>& m, double radius) {
  Mat93 padded = Mat93::Zero();
  padded.topRows<6>() = m;
  const RightSvd<3> svd = jacobi_right_svd(padded);
  const Vec3 inverse = svd.sigma.cwiseInverse();
  // An approximate left inverse Y: where |Y m - 1| <= z < 1, no singular value is below (1 - z) / |Y|.
  const Mat36 y = svd.v * inverse.asDiagonal() * (m * svd.v * inverse.asDiagonal()).transpose();
  const double size = norm_above(y);
  const Interval z = Interval(distance_from_identity(y, m)) + Interval(size) * radius;
  if (!(z.hi < 1.0)) return 0.0;
  return std::max(((1.0 - z) / Interval(size)).lo, 0.0);
}

}  // namespace ninedof
