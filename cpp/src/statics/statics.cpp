#include "ninedof/statics/statics.hpp"

#include <cmath>

#include "kinematics/rate_matrix.hpp"
#include "math/linear/jacobi_svd.hpp"
#include "math/linear/least_squares.hpp"
#include "math/numbers.hpp"
#include "ninedof/conditioning/characteristic_length.hpp"
#include "ninedof/math/error.hpp"
#include "statics/balance.hpp"

namespace ninedof {
namespace {

/// If all pivots of a QR factorization of a 9x9 matrix exceed this fraction of the first, all singular values exceed
/// 1/600 of this fraction of the largest: the matrix is far from singular, and its singular values are not needed.
constexpr double surely_regular = 1e-9;

/// The work of a balanced load on the free motions is rounding, up to this fraction of the load.
constexpr double rounding = 64.0 * eps;

/// H with rotations and moments scaled by the platform radius, so that no rank depends on the length unit.
struct Scaled {
  double length;
  Mat9 h;
};

Scaled scaled_rates(const Geometry& g, const Configuration& c) {
  const double length = characteristic_length(g, c, LengthKind::platform_radius);
  return {length, rate_matrix(g, c, length)};
}

Load load_from(const Vec9& v, double length) {
  return {length * v.head<3>(), v.segment<3>(3), v.tail<3>()};
}

void require_stiffness(const Vec9& k) {
  for (const double value : k)
    if (value < 0.0 || std::isinf(value))
      throw InvalidArgument("leg_stiffness", format_number(value), "finite numbers >= 0");
}

}  // namespace

LegForces leg_forces(const Geometry& g, const Configuration& c, const Load& load) {
  const auto [length, h] = scaled_rates(g, c);
  return leg_forces(h, length, load);
}

LegForces leg_forces(const Mat9& h, double length, const Load& load) {
  Vec9 wanted;
  wanted << -load.moment / length, -load.force, -load.force_at_o;
  if (!h.allFinite() || !wanted.allFinite()) {
    const Vec9 nothing = Vec9::Constant(not_a_number);
    return {nothing, load_from(nothing, 1.0)};
  }
  const Mat9 transposed = h.transpose();
  if (const auto forces = solve_regular(transposed, wanted, surely_regular)) return {*forces, {}};

  const Svd<9> svd = jacobi_svd(transposed);  // the last columns of U are the free motions
  const Eigen::Index rank = svd.rank(negligible);
  Vec9 along = svd.u.transpose() * wanted;  // components of the load along the motions
  Vec9 lost = Vec9::Zero();
  for (Eigen::Index k = rank; k < 9; ++k) {
    if (std::abs(along[k]) > rounding * wanted.norm()) lost -= along[k] * svd.u.col(k);
    along[k] = 0.0;
  }
  along.head(rank).array() /= svd.sigma.head(rank).array();
  Vec9 forces = svd.v * along;
  for (Eigen::Index k = 0; k < 9; ++k)
    if (h.row(k).isZero(0.0)) forces[k] = 0.0;  // a leg of zero length: exactly zero
  return {forces, load_from(lost, length)};
}

SelfStress self_stress(const Geometry& g, const Configuration& c) {
  const Mat9 h = scaled_rates(g, c).h;
  if (!h.allFinite()) return SelfStress::Constant(9, 1, not_a_number);
  const Svd<9> svd = jacobi_svd(Mat9(h.transpose()));
  SelfStress out = svd.v.rightCols(9 - svd.rank(negligible));
  for (Eigen::Index k = 0; k < out.cols(); ++k) {
    Eigen::Index largest = 0;
    out.col(k).cwiseAbs().maxCoeff(&largest);
    if (out(largest, k) < 0.0) out.col(k) = -out.col(k);
  }
  return out;
}

Mat9 stiffness_with_o(const Geometry& g, const Configuration& c, const Vec9& leg_stiffness) {
  require_stiffness(leg_stiffness);
  const Mat9 x = leg_stiffness.cwiseSqrt().asDiagonal() * rate_matrix(g, c);
  return x.transpose().lazyProduct(x);
}

Mat6 stiffness(const Geometry& g, const Configuration& c, const Vec9& leg_stiffness) {
  require_stiffness(leg_stiffness);
  const Mat9 x = leg_stiffness.cwiseSqrt().asDiagonal() * rate_matrix(g, c);
  if (!x.allFinite()) return Mat6::Constant(not_a_number);
  const Mat96 platform = eliminate(x.rightCols<3>(), Mat96(x.leftCols<6>()));
  return platform.transpose().lazyProduct(platform);
}

LeastStiffness least_stiffness(const Geometry& g, const Configuration& c, const Vec9& leg_stiffness) {
  require_stiffness(leg_stiffness);
  const Mat9 x = leg_stiffness.cwiseSqrt().asDiagonal() * rate_matrix(g, c);
  if (!x.allFinite()) return {not_a_number, not_a_number};
  // A factor of each Schur complement: the square of its least singular value is the least eigenvalue, without the
  // digits that a difference of products would lose.
  const Mat96 platform = eliminate(x.rightCols<3>(), Mat96(x.leftCols<6>()));
  const Mat93 turn = platform.leftCols<3>(), shift = platform.rightCols<3>();
  const auto least = [](const Mat93& part, const Mat93& other) {
    const double sigma = jacobi_right_svd(eliminate(other, part)).sigma[2];
    return sigma * sigma;
  };
  return {least(shift, turn), least(turn, shift)};
}

}  // namespace ninedof
