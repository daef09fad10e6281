#include "proof/numbers/leg_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "proof/numbers/exact_dot.hpp"

namespace ninedof {
namespace {

/// A sum of points and of turned vectors.
class VectorSum {
 public:
  VectorSum& add(double sign, const Vec3& v) {
    for (std::size_t k = 0; k < 3; ++k) at_[k].number(sign * v[static_cast<Eigen::Index>(k)]);
    return *this;
  }
  VectorSum& add(double sign, const Mat3& q, const Vec3& v) {
    for (std::size_t k = 0; k < 3; ++k)
      for (Eigen::Index i = 0; i < 3; ++i) at_[k].product(sign * q(static_cast<Eigen::Index>(k), i), v[i]);
    return *this;
  }
  Xyz<Interval> value() const { return {at_[0].value(), at_[1].value(), at_[2].value()}; }

 private:
  std::array<DotSum, 3> at_;
};

/// x 2^power, moved outwards where it is rounded: below the normal numbers, and beyond the largest.
double times_power_outwards(double x, int power, double outwards) {
  const double y = std::ldexp(x, power);
  if (std::isinf(y) && std::isfinite(x) && (y > 0.0) != (outwards > 0.0))
    return std::copysign(detail::greatest_double, y);
  return x != 0.0 && std::abs(y) < std::numeric_limits<double>::min() ? y + outwards : y;
}

}  // namespace

Interval times_power_of_two(const Interval& x, int power) {
  return {times_power_outwards(x.lo, power, -detail::least_double),
          times_power_outwards(x.hi, power, detail::least_double)};
}

DirectionBounds direction_bounds(const Xyz<Interval>& v) {
  const Interval any(-1.0, 1.0);
  const double size = std::max({magnitude(v.x), magnitude(v.y), magnitude(v.z)});
  if (!std::isfinite(size)) return {{0.0, detail::no_bound}, {any, any, any}};
  // Squares of very small and very large vectors would leave the doubles.
  const int power = size > 0.0 ? std::ilogb(size) : 0;
  const auto scaled = [&](const Interval& x) { return times_power_of_two(x, -power); };
  const Xyz<Interval> at = {scaled(v.x), scaled(v.y), scaled(v.z)};
  const Interval norm = sqrt(square(at.x) + square(at.y) + square(at.z));
  const Interval length = times_power_of_two(norm, power);
  const auto unit = [&](const Interval& x) {
    if (!(norm.lo > 0.0)) return any;
    const Interval e = x / norm;
    return Interval(std::max(e.lo, -1.0), std::min(e.hi, 1.0));
  };
  return {{std::max(length.lo, 0.0), length.hi}, {unit(at.x), unit(at.y), unit(at.z)}};
}

LegBounds leg_bounds(const Geometry& g, const Configuration& c) {
  const Vec3 &p = c.position, &s = c.internal_point;
  const Mat3& q = c.rotation;
  LegBounds out;
  out.y = VectorSum().add(1.0, s).add(-1.0, p).value();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &u = g.platform_external()[i], &u_tilde = g.platform_internal()[i];
    const Vec3 &r = g.base_external()[i], &r_hat = g.base_internal()[i];
    out.u[i] = VectorSum().add(1.0, q, u).value();
    out.u_tilde[i] = VectorSum().add(1.0, q, u_tilde).value();
    out.legs[i] = direction_bounds(VectorSum().add(1.0, p).add(1.0, q, u).add(-1.0, r).value());
    out.legs[i + 3] = direction_bounds(VectorSum().add(1.0, s).add(-1.0, p).add(-1.0, q, u_tilde).value());
    out.legs[i + 6] = direction_bounds(VectorSum().add(1.0, s).add(-1.0, r_hat).value());
    out.d[i] = VectorSum().add(1.0, r).add(-1.0, s).value();
    out.w[i] = VectorSum().add(1.0, p).add(1.0, q, u).add(-1.0, s).value();
  }
  return out;
}

}  // namespace ninedof
