#include "ninedof/statics/ellipsoid.hpp"

#include "kinematics/rate_matrix.hpp"
#include "math/linear/jacobi_svd.hpp"
#include "math/linear/least_squares.hpp"
#include "math/linear/svd6.hpp"
#include "math/numbers.hpp"

namespace ninedof {
namespace {

/// X with |X t| the least norm of leg rates over all motions of O at the twist t. The conditioning matrix M has
/// X^T X = M^T M, except if all internal legs lie in a plane: there M lacks a row.
Mat96 least_rates(const Geometry& g, const Configuration& c, double characteristic_length) {
  const Mat9 h = rate_matrix(g, c, characteristic_length);
  if (!h.allFinite()) return Mat96::Constant(not_a_number);
  return eliminate(h.rightCols<3>(), Mat96(h.leftCols<6>()));
}

/// {y : |X y| <= 1} from the singular values of X, zero up to `threshold`, and its right singular vectors.
template <int N>
Ellipsoid<N> unit_ball_of(const Eigen::Matrix<double, N, 1>& sigma, const Eigen::Matrix<double, N, N>& v,
                          double threshold) {
  Ellipsoid<N> out{v.rowwise().reverse(), sigma.reverse()};
  for (Eigen::Index k = 0; k < N; ++k) {
    double& axis = out.semi_axes[k];
    axis = axis <= threshold ? infinity : 1.0 / axis;
    Eigen::Index largest = 0;
    out.directions.col(k).cwiseAbs().maxCoeff(&largest);
    if (out.directions(largest, k) < 0.0) out.directions.col(k) *= -1.0;
  }
  return out;
}

template <int N>
Ellipsoid<N> no_ellipsoid() {
  return {Eigen::Matrix<double, N, N>::Constant(not_a_number), Eigen::Matrix<double, N, 1>::Constant(not_a_number)};
}

/// {w : |w.y| <= 1 for all y of `e`}.
template <int N>
Ellipsoid<N> polar(const Ellipsoid<N>& e) {
  return {e.directions.rowwise().reverse(), e.semi_axes.cwiseInverse().reverse()};
}

}  // namespace

Ellipsoid<6> velocity_ellipsoid(const Geometry& g, const Configuration& c, double characteristic_length) {
  const Mat96 x = least_rates(g, c, characteristic_length);
  if (x.hasNaN()) return no_ellipsoid<6>();
  const RightSvd<6> svd = right_svd_6x6(triangular_factor(x));
  return unit_ball_of<6>(svd.sigma, svd.v, negligible * svd.sigma[0]);
}

Ellipsoid<3> velocity_ellipsoid(const Geometry& g, const Configuration& c, TwistPart part,
                                double characteristic_length) {
  const Mat96 x = least_rates(g, c, characteristic_length);
  if (x.hasNaN()) return no_ellipsoid<3>();
  const bool rotation = part == TwistPart::rotation;
  const Mat93 part_columns = rotation ? x.leftCols<3>() : x.rightCols<3>();
  const Mat93 other = rotation ? x.rightCols<3>() : x.leftCols<3>();
  // The other part takes the value that minimizes the leg rates.
  const RightSvd<3> svd = jacobi_right_svd(eliminate(other, part_columns));
  return unit_ball_of<3>(svd.sigma, svd.v, negligible * part_columns.norm());
}

Ellipsoid<6> force_ellipsoid(const Geometry& g, const Configuration& c, double characteristic_length) {
  return polar(velocity_ellipsoid(g, c, characteristic_length));
}

Ellipsoid<3> force_ellipsoid(const Geometry& g, const Configuration& c, TwistPart part, double characteristic_length) {
  return polar(velocity_ellipsoid(g, c, part, characteristic_length));
}

}  // namespace ninedof
