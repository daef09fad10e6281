#include "support/oracle.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <complex>
#include <vector>

#include "math/numbers.hpp"

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

using Svd = Eigen::JacobiSVD<Matrix, Eigen::NoQRPreconditioner>;

/// Zeros make the matrix square: the QR decomposition for other shapes would take twice the time to compile.
Svd decomposed(const Matrix& m, unsigned vectors = 0) {
  const Eigen::Index n = std::max(m.rows(), m.cols());
  Matrix square = Matrix::Zero(n, n);
  square.topLeftCorner(m.rows(), m.cols()) = m;
  return Svd(square, vectors);
}

struct Eliminated {
  Matrix x;
  Real determinant;
};

/// a x = b by Gauss-Jordan elimination with complete pivoting.
Eliminated eliminate(Matrix a, Matrix b) {
  const Eigen::Index n = a.rows();
  std::vector<Eigen::Index> unknown(static_cast<std::size_t>(n));
  for (Eigen::Index k = 0; k < n; ++k) unknown[static_cast<std::size_t>(k)] = k;
  Eliminated out{Matrix(n, b.cols()), 1};
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index row = k, column = k;
    for (Eigen::Index j = k; j < n; ++j)
      for (Eigen::Index i = k; i < n; ++i)
        if (std::abs(a(i, j)) > std::abs(a(row, column))) row = i, column = j;
    a.row(k).swap(a.row(row));
    b.row(k).swap(b.row(row));
    a.col(k).swap(a.col(column));
    std::swap(unknown[static_cast<std::size_t>(k)], unknown[static_cast<std::size_t>(column)]);
    out.determinant *= (row == k) == (column == k) ? a(k, k) : -a(k, k);
    if (a(k, k) == 0) break;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (i == k) continue;
      const Real factor = a(i, k) / a(k, k);
      a.row(i) -= factor * a.row(k);
      b.row(i) -= factor * b.row(k);
    }
  }
  for (Eigen::Index k = 0; k < n; ++k) out.x.row(unknown[static_cast<std::size_t>(k)]) = b.row(k) / a(k, k);
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
  Matrix out = inverse(rates(g, c)).topRows(6);
  out.topRows(3) *= static_cast<Real>(characteristic_length);
  return out;
}

Real condition_number(const ninedof::Geometry& g, const ninedof::Configuration& c, double characteristic_length) {
  const Vector sigma = singular_values(jacobian(g, c, characteristic_length));
  return sigma[0] / sigma[5];
}

double conditioning_of_rates(const ninedof::Geometry& g, const ninedof::Configuration& c) {
  return conditioning_of(rates(g, c));
}

Matrix wide(const Eigen::Ref<const Eigen::MatrixXd>& m) {
  return m.cast<Real>();
}

Eigen::MatrixXd rounded(const Matrix& m) {
  return m.cast<double>();
}

Matrix product(const Matrix& a, const Matrix& b) {
  return a.lazyProduct(b);
}

Matrix congruence(const Matrix& m, const Vector& weights) {
  return product(m * weights.asDiagonal(), m.transpose());
}

double from_orthonormal(const Matrix& m) {
  return static_cast<double>((product(m.transpose(), m) - Matrix::Identity(m.cols(), m.cols())).norm());
}

Matrix solve(const Matrix& a, const Matrix& b) {
  return eliminate(a, b).x;
}

Matrix inverse(const Matrix& m) {
  return solve(m, Matrix::Identity(m.rows(), m.cols()));
}

Real determinant(const Matrix& m) {
  return eliminate(m, Matrix::Zero(m.rows(), 0)).determinant;
}

Eigen::Index rank(const Matrix& m) {
  const Vector sigma = singular_values(m);
  return (sigma.array() > static_cast<Real>(ninedof::eps) * static_cast<Real>(sigma.size()) * sigma[0]).count();
}

Vector singular_values(const Matrix& m) {
  return decomposed(m).singularValues().head(std::min(m.rows(), m.cols()));
}

double least_singular_value(const Eigen::Ref<const Eigen::MatrixXd>& m) {
  return static_cast<double>(singular_values(wide(m)).minCoeff());
}

double conditioning_of(const Matrix& m) {
  const Vector sigma = singular_values(m);
  return static_cast<double>(sigma[0] / sigma[sigma.size() - 1]);
}

Matrix right_singular_vectors(const Matrix& m) {
  return decomposed(m, Eigen::ComputeFullV).matrixV().topLeftCorner(m.cols(), m.cols());
}

Vector least_squares(const Matrix& a, const Vector& b, Real threshold) {
  const auto svd = decomposed(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector sigma = svd.singularValues().head(std::min(a.rows(), a.cols()));
  Vector x = Vector::Zero(a.cols());
  for (Eigen::Index k = 0; k < sigma.size(); ++k)
    if (sigma[k] > threshold * sigma[0])
      x += svd.matrixU().col(k).head(b.size()).dot(b) / sigma[k] * svd.matrixV().col(k).head(x.size());
  return x;
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& m) {
  // Shifted by more than their size they are singular values.
  Matrix shifted = wide(m);
  const Real shift = shifted.norm();
  shifted.diagonal().array() += shift;
  return (singular_values(shifted).reverse().array() - shift).cast<double>();
}

Matrix left_singular_vectors(const Matrix& m) {
  return decomposed(m, Eigen::ComputeFullU).matrixU().topLeftCorner(m.rows(), m.rows());
}

}  // namespace oracle
