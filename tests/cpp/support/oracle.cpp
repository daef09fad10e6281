#include "support/oracle.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <array>
#include <complex>

namespace oracle {
namespace {

using Complex = std::complex<Real>;
using Point = std::array<Complex, 3>;

Point point(const ninedof::Vec3& v) {
  return {Complex(v[0]), Complex(v[1]), Complex(v[2])};
}

/// Nine coordinates: infinitesimal rotation of the platform, position of the platform, internal point.
using Step = std::array<Complex, 9>;

/// p + (1 + omega x) Q u: to first order the platform joint after the step, and only the first order is used.
Point platform_joint(const ninedof::Configuration& c, const ninedof::Vec3& u, const Step& d) {
  const Eigen::Matrix<Real, 3, 1> turned = c.rotation.cast<Real>() * u.cast<Real>();
  const Eigen::Matrix<Real, 3, 1> at = c.position.cast<Real>() + turned;
  return {at[0] + d[3] + d[1] * turned[2] - d[2] * turned[1], at[1] + d[4] + d[2] * turned[0] - d[0] * turned[2],
          at[2] + d[5] + d[0] * turned[1] - d[1] * turned[0]};
}

Complex distance(const Point& a, const Point& b) {
  Complex sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

std::array<Complex, 9> lengths(const ninedof::Geometry& g, const ninedof::Configuration& c, const Step& d) {
  Point o = point(c.internal_point);
  for (std::size_t k = 0; k < 3; ++k) o[k] += d[k + 6];
  std::array<Complex, 9> out;
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = distance(platform_joint(c, g.platform_external()[i], d), point(g.base_external()[i]));
    out[i + 3] = distance(o, platform_joint(c, g.platform_internal()[i], d));
    out[i + 6] = distance(o, point(g.base_internal()[i]));
  }
  return out;
}

}  // namespace

Vector leg_lengths(const ninedof::Geometry& g, const ninedof::Configuration& c) {
  const auto complex = lengths(g, c, {});
  Vector out(9);
  for (std::size_t i = 0; i < 9; ++i) out[static_cast<Eigen::Index>(i)] = complex[i].real();
  return out;
}

Matrix rates(const ninedof::Geometry& g, const ninedof::Configuration& c) {
  constexpr Real step = 1e-60L;  // no difference is taken, so no digits are lost however small it is
  Matrix out(9, 9);
  for (std::size_t k = 0; k < 9; ++k) {
    Step d{};
    d[k] = Complex(0, step);
    const auto moved = lengths(g, c, d);
    for (std::size_t i = 0; i < 9; ++i)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = moved[i].imag() / step;
  }
  return out;
}

Matrix jacobian(const ninedof::Geometry& g, const ninedof::Configuration& c, double characteristic_length) {
  Matrix out = rates(g, c).fullPivLu().inverse().topRows(6);
  out.topRows(3) *= static_cast<Real>(characteristic_length);
  return out;
}

Vector singular_values(const Matrix& m) {
  return m.jacobiSvd().singularValues();
}

Real condition_number(const ninedof::Geometry& g, const ninedof::Configuration& c, double characteristic_length) {
  const Vector sigma = singular_values(jacobian(g, c, characteristic_length));
  return sigma[0] / sigma[5];
}

}  // namespace oracle
