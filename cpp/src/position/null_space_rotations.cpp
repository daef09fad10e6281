/// Declared in position/rotation_problem.hpp.
///
/// For a unit quaternion z each equation is a quadric, z^T K_i z = 0, and three quadrics in projective space meet in
/// eight points. These are the eigenvectors of an 8x8 matrix, found in the null space of all products of the quadrics
/// with quadratic monomials (Macaulay's matrix). Half turns, symmetric robots and coinciding joints are no special
/// cases.

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <optional>

#include "math/linear/eigenvectors.hpp"
#include "math/linear/householder.hpp"
#include "position/quaternion_monomials.hpp"
#include "position/rotation_problem.hpp"

namespace ninedof {
namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;
using Mat8 = Eigen::Matrix<double, 8, 8>;
using Quadric = Eigen::Matrix<double, 10, 1>;    // coefficients of the quadratic monomials
using Quadrics = Eigen::Matrix<double, 10, 3>;
using Macaulay = Eigen::Matrix<double, 36, 30>;  // 35 monomials of degree four and a row of zeros; 3 x 10 products
using Basis = Eigen::Matrix<double, 36, 8>;

constexpr auto linear_by_linear = monomials::products<1, 1>();
constexpr auto linear_by_cubic = monomials::products<1, 3>();
constexpr auto quadratic_by_quadratic = monomials::products<2, 2>();

constexpr int rank = 27;                   // three of the thirty products depend on the others: K_i K_j = K_j K_i
constexpr double rank_gap = 1e-10;  // smallest relative pivot: 1e-16 if solutions form a curve, typically 1e-2
constexpr double dependent = 1e-13;  // size of what a quadric adds to the others: below it is rounding
constexpr double smallest_divisor = 1e-9;  // singular value of SG; below it a solution nearly satisfies g = 0
constexpr double nearly_real = 0.05;  // |Im z| / |z|: a loose bound, the polished residual decides

/// Linear forms in general position; the multiplication matrix has the eigenvalue f(z) / g(z) at the solution z. The
/// rows of g are orthogonal, so that no z satisfies g = 0 for all four.
struct Forms {
  Vec4 f;
  Mat4 g;
};

Forms general_forms() {
  constexpr double a = 0.6821, b = 0.2714, c = -0.3917, d = 0.5547;
  Forms forms;
  forms.f << 0.2874, -0.7719, 0.4163, 0.3866;
  forms.g << a, b, c, d, -b, a, -d, c, -c, d, a, -b, -d, -c, b, a;
  return forms;
}

/// z^T K z = |z|^2 (d . Q(z) w - c), over the Frobenius norm of K, whose eigenvalues are 1 - c and -1 - c, each twice.
Quadric quadric(const Vec3& d, const Vec3& w, double c) {
  Mat4 k;
  const double dot = d.dot(w);
  k(0, 0) = dot - c;
  k.bottomLeftCorner<3, 1>() = w.cross(d);
  k.bottomRightCorner<3, 3>() = d * w.transpose() + w * d.transpose() - (dot + c) * Mat3::Identity();
  k *= 0.5 / std::sqrt(1.0 + c * c);
  Quadric out;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b <= a; ++b) out[linear_by_linear[a][b]] = (a == b ? 1.0 : 2.0) * k(a, b);
  return out;
}

Quadrics quadrics(const RotationProblem& p) {
  Quadrics out;
  for (int i = 0; i < 3; ++i) out.col(i) = quadric(p.d[at_index(i)], p.w[at_index(i)], p.c[i]);
  return out;
}

/// Three quadrics, and how much the last adds to the others: 1 where they are orthogonal.
struct Independent {
  Quadrics k;
  double added;
};

/// Orthonormal combinations, which have the same solutions, by Gram and Schmidt: columns that nearly agree, because
/// directions are nearly parallel, give a nearly singular Macaulay matrix. None if they are dependent within rounding.
std::optional<Independent> orthonormal(Quadrics k) {
  double added = 1.0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    Eigen::Index pivot = 0;
    added = std::sqrt(k.rightCols(3 - i).colwise().squaredNorm().maxCoeff(&pivot));
    if (!(added > dependent)) return {};
    const Quadric first = k.col(i + pivot).normalized();
    k.col(i + pivot) = k.col(i);
    k.col(i) = first;
    for (int twice = 0; twice < 2; ++twice)
      for (Eigen::Index j = i + 1; j < 3; ++j) k.col(j) -= first.dot(k.col(j)) * first;
  }
  return Independent{k, added};
}

/// Columns: the coefficients of every product of a quadric and a quadratic monomial.
Macaulay macaulay(const Quadrics& k) {
  Macaulay out = Macaulay::Zero();
  for (int i = 0; i < 3; ++i)
    for (int m = 0; m < 10; ++m)
      for (int t = 0; t < 10; ++t) out(quadratic_by_quadratic[m][t], 10 * i + m) = k(t, i);
  return out;
}

/// Orthonormal basis of the complement of the columns, and the least pivot relative to the first.
struct NullSpace {
  Basis basis;
  double gap;
};

/// By QR with column pivoting; none if the rank of the columns is below 27.
std::optional<NullSpace> null_space(Macaulay a) {
  std::array<Reflection<36>, rank> reflections;
  double first = 0.0, last = 0.0;
  for (int k = 0; k < rank; ++k) {
    // Computed again for every pivot: norms updated by subtraction lose all digits before they reach 1e-10.
    Eigen::Index pivot = 0;
    const double norm = a.bottomRightCorner(36 - k, 30 - k).colwise().squaredNorm().maxCoeff(&pivot);
    if (k == 0) first = norm;
    if (norm <= rank_gap * rank_gap * first) return {};
    last = norm;
    pivot += k;
    Reflection<36>& r = reflections[at_index(k)] = {a.col(pivot), k};
    a.col(pivot) = a.col(k);
    reflect(r, a, k + 1);
  }
  Basis n = Basis::Zero();
  n.middleRows<8>(rank).setIdentity();
  for (auto r = reflections.rbegin(); r != reflections.rend(); ++r) reflect(*r, n, 0);
  return NullSpace{n, std::sqrt(last / first)};
}

/// The multiplication matrix X of SG X = SF, by least squares: SF and SG are the rows of f m and g m in the null space
/// for the twenty cubic monomials m. None if SG is nearly singular.
std::optional<Mat8> multiplication(const Basis& n, const Vec4& f, const Vec4& g) {
  Eigen::Matrix<double, 20, 16> s = Eigen::Matrix<double, 20, 16>::Zero();  // [SG SF]
  for (int j = 0; j < 8; ++j)
    for (int k = 0; k < 4; ++k)
      for (int m = 0; m < 20; ++m) {
        const double value = n(linear_by_cubic[k][m], j);
        s(m, j) += g[k] * value;
        s(m, j + 8) += f[k] * value;
      }
  for (int k = 0; k < 8; ++k) {
    const Reflection<20> r(s.col(k), k);
    s(k, k) = r.image;
    reflect(r, s, k + 1);
  }
  // The Frobenius norm of R^-1 is the reciprocal of the smallest singular value times a factor between 1 and sqrt 8.
  const Mat8 inverse = s.topLeftCorner<8, 8>().triangularView<Eigen::Upper>().solve(Mat8::Identity());
  if (!(inverse.norm() * smallest_divisor < 1.0)) return {};
  return inverse.triangularView<Eigen::Upper>() * s.topRightCorner<8, 8>();
}

/// The quaternion z with z_k^3 z_j = v[4 k + j] up to a factor. Its largest component is 1: real where z can be.
Eigen::Vector4cd quaternion(const Eigen::Matrix<std::complex<double>, 16, 1>& v) {
  Eigen::Index k = 0;
  Vec4(std::norm(v[0]), std::norm(v[5]), std::norm(v[10]), std::norm(v[15])).maxCoeff(&k);
  return v.segment<4>(4 * k) / v[5 * k];
}

void add(const Vec4& z, RotationCandidates& out) {
  out.rotation[at_index(out.count++)] = Eigen::Quaterniond(z[0], z[1], z[2], z[3]).normalized().toRotationMatrix();
}

/// For each eigenvector x of the multiplication matrix, n x holds the values of all monomials at a solution, up to a
/// factor. Returns false if the eigenvalues did not converge.
bool add_real_solutions(const Basis& n, const Mat8& multiplied, RotationCandidates& out) {
  const RealEigen8 eigen = real_eigen(multiplied);
  if (!eigen.converged) return false;
  Eigen::Matrix<double, 16, 8> rows;  // of z_k^3 z_j
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      rows.row(4 * k + j) = n.row(quadratic_by_quadratic[linear_by_linear[k][k]][linear_by_linear[k][j]]);
  // A real eigenvalue has one column here. A conjugate pair has two, the real and the imaginary part of an eigenvector.
  const Eigen::Matrix<double, 16, 8> values = rows * eigen.vectors;
  for (Eigen::Index j = 0; j < 8; ++j) {
    const bool pair = eigen.values[j].imag() != 0.0;
    Eigen::Matrix<std::complex<double>, 16, 1> v = values.col(j).cast<std::complex<double>>();
    if (pair) v.imag() = values.col(++j);
    const Eigen::Vector4cd z = quaternion(v);
    if (!z.real().allFinite() || !z.imag().allFinite())
      return false;  // the solution is unknown: no component to scale by
    if (!(z.imag().norm() < nearly_real * z.norm())) continue;
    // Two real solutions close together may come as a conjugate pair: they lie on both sides of its real part.
    add(z.real() + z.imag(), out);
    if (pair) add(z.real() - z.imag(), out);
  }
  return true;
}

}  // namespace

RotationCandidates null_space_rotations(const RotationProblem& problem) {
  static const Forms forms = general_forms();
  RotationCandidates out;
  const Quadrics k = quadrics(problem);
  out.reliable = k.allFinite();
  if (!out.reliable) return out;
  std::optional<NullSpace> n = null_space(macaulay(k));
  double added = 1.0;
  if (!n)
    if (const std::optional<Independent> independent = orthonormal(k)) {
      n = null_space(macaulay(independent->k));
      added = independent->added;
    }
  out.self_motion = !n;
  if (out.self_motion) return out;
  out.sensitivity = 1.0 / (added * n->gap);
  for (int row = 0; row < 4; ++row) {
    const std::optional<Mat8> multiplied = multiplication(n->basis, forms.f, forms.g.row(row));
    if (multiplied && add_real_solutions(n->basis, *multiplied, out)) return out;
  }
  out.reliable = false;
  return out;
}

}  // namespace ninedof
