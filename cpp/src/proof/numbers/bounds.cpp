#include "ninedof/proof/bounds.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "conditioning/null_space.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "proof/numbers/condition_bounds.hpp"
#include "proof/numbers/leg_bounds.hpp"
#include "proof/numbers/matrix_ball.hpp"
#include "proof/numbers/verified_singular_values.hpp"

namespace ninedof {
namespace {

Interval within_one(const Interval& x) {
  return {std::max(x.lo, -1.0), std::min(x.hi, 1.0)};
}

Interval determinant_of(const std::array<Xyz<Interval>, 3>& rows) {
  return within_one(dot(rows[0], cross(rows[1], rows[2])));
}

/// A ball around the conditioning matrix M, for one choice of the basis [N_q N_r].
struct ConditioningBall {
  Mat6 middle;
  double radius;
};

ConditioningBall conditioning_ball(const LegBounds& k, double characteristic_length) {
  const Interval lc(characteristic_length);
  MatrixBall<3, 6> a, e;
  MatrixBall<6, 3> cb;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const auto moment = [&](const Xyz<Interval>& u, const Xyz<Interval>& direction) {
      const Xyz<Interval> m = cross(u, direction);
      return Xyz<Interval>{m.x / lc, m.y / lc, m.z / lc};
    };
    const Xyz<Interval>&external = k.legs[i].unit, &upper = k.legs[i + 3].unit, &lower = k.legs[i + 6].unit;
    a.set(row, 0, moment(k.u[i], external));
    a.set(row, 3, external);
    e.set(row, 0, moment(k.u_tilde[i], upper));
    e.set(row, 3, upper);
    cb.set(row, 0, upper);
    cb.set(row + 3, 0, lower);
  }

  // How far the basis found is from an orthonormal one of the exact null space.
  const Mat36 basis = null_space(cb.middle.topRows<3>(), cb.middle.bottomRows<3>());
  const Eigen::Matrix<double, 6, 3> transposed = basis.transpose();
  const Interval skewness = distance_from_identity(basis, transposed);
  const Interval size = sqrt(1.0 + skewness);  // of the basis, from above
  const MatrixBall<3, 3> product = exact_product(basis, cb.middle);
  const Interval residual = Interval(norm_above(product.middle)) + product.radius() + size * cb.radius();
  const Interval outside = residual / least_singular_value(cb.middle, cb.radius());
  const Interval defect = skewness + square(outside);
  const Interval distance = defect + outside;

  const Mat3 n_q = basis.leftCols<3>();
  const MatrixBall<3, 6> lower = exact_product(n_q, e.middle);
  const Interval of_e = Interval(norm_above(e.middle)) + e.radius();
  const Interval lower_radius = Interval(lower.radius()) + size * e.radius() + distance * of_e;
  ConditioningBall out;
  out.middle << a.middle, lower.middle;
  out.radius = defect.hi < 1.0 ? sqrt(square(Interval(a.radius())) + square(lower_radius)).hi : detail::no_bound;
  return out;
}

/// The singular values of M, descending; those of J' are their reciprocals.
std::array<Interval, 6> inverse_singular_value_bounds(const Geometry& g, const Configuration& c,
                                                      double characteristic_length) {
  require_length("characteristic_length", characteristic_length);
  require_sound_arithmetic();
  const ConditioningBall m = conditioning_ball(leg_bounds(g, c), characteristic_length);
  return verified_singular_values(m.middle, m.radius);
}

}  // namespace

std::array<Interval, 9> leg_length_bounds(const Geometry& g, const Configuration& c) {
  require_sound_arithmetic();
  const LegBounds k = leg_bounds(g, c);
  std::array<Interval, 9> out;
  for (std::size_t i = 0; i < 9; ++i) out[i] = k.legs[i].length;
  return out;
}

std::array<Interval, 6> singular_value_bounds(const Geometry& g, const Configuration& c, double characteristic_length) {
  const std::array<Interval, 6> of_m = inverse_singular_value_bounds(g, c, characteristic_length);
  std::array<Interval, 6> out;
  for (std::size_t i = 0; i < 6; ++i) out[i] = ratio_bounds(1.0, of_m[5 - i]);
  return out;
}

Interval condition_number_bounds(const Geometry& g, const Configuration& c, double characteristic_length) {
  const std::array<Interval, 6> of_m = inverse_singular_value_bounds(g, c, characteristic_length);
  return at_least_one(ratio_bounds(of_m[0], of_m[5]));
}

DeterminantBounds determinant_bounds(const Geometry& g, const Configuration& c) {
  require_sound_arithmetic();
  const LegBounds k = leg_bounds(g, c);
  std::array<Xyz<Interval>, 3> n;
  for (std::size_t i = 0; i < 3; ++i) n[i] = cross(direction_bounds(k.d[i]).unit, direction_bounds(k.w[i]).unit);
  return {determinant_of(n), determinant_of({k.legs[6].unit, k.legs[7].unit, k.legs[8].unit}),
          determinant_of({k.legs[3].unit, k.legs[4].unit, k.legs[5].unit})};
}

}  // namespace ninedof
