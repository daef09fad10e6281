/// A bound of the condition number over a box. Declared in proof/checker/wants.hpp.

#include <cmath>

#include "proof/checker/wants.hpp"

namespace ninedof::checker::sets {
namespace {

template <class T, std::size_t N>
using Square = std::array<std::array<T, N>, N>;
constexpr std::size_t six = 6;
using Vector6 = std::array<double, six>;

void add_outer(const Arrow& v, Square<Linear, 3>& out) {
  const std::array x{v.x, v.y, v.z};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = out[i][j] + x[i] * x[j];
}

/// A symmetric matrix times its inverse's determinant.
Square<Linear, 3> cofactors(const Square<Linear, 3>& of) {
  Square<Linear, 3> out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      out[i][j] = of[a][c] * of[b][d] - of[a][d] * of[b][c];
    }
  return out;
}
Linear inverse_determinant(const Square<Linear, 3>& of, const Square<Linear, 3>& cofactor) {
  return inverse(of[0][0] * cofactor[0][0] + of[0][1] * cofactor[0][1] + of[0][2] * cofactor[0][2]);
}

/// H (H + F)^-1 F by cofactors.
Square<Linear, 3> parallel_sum(const Square<Linear, 3>& h, const Square<Linear, 3>& f) {
  Square<Linear, 3> sum, first, out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum[i][j] = h[i][j] + f[i][j];
  const Square<Linear, 3> cofactor = cofactors(sum);
  const Linear over = inverse_determinant(sum, cofactor);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      first[i][j] = h[i][0] * cofactor[0][j] + h[i][1] * cofactor[1][j] + h[i][2] * cofactor[2][j];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      out[i][j] = over * (first[i][0] * f[0][j] + first[i][1] * f[1][j] + first[i][2] * f[2][j]);
  return out;
}

/// The same with a leg that keeps its length. Three legs that move by r give O the motion of the sum of r_k n_k / det,
/// where n_k is the product of the directions of the other two: H^-1 is the sum of n_k n_k^T / det^2, over legs that
/// move.
Square<Linear, 3> parallel_sum(const Mount& m, const Stand& at, int locked) {
  Square<Linear, 3> sum;
  for (int first = 3; first < 9; first += 3) {
    std::array<Arrow, 3> e;
    for (int k = 0; k < 3; ++k) e[static_cast<std::size_t>(k)] = unit(leg_line(m, at, first + k).along());
    const Linear det = dot(e[0], cross(e[1], e[2])), over = inverse(det * det);
    Square<Linear, 3> squares;
    for (int k = 0; k < 3; ++k)
      if (first + k != locked)
        add_outer(cross(e[static_cast<std::size_t>((k + 1) % 3)], e[static_cast<std::size_t>((k + 2) % 3)]), squares);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) sum[i][j] = sum[i][j] + over * squares[i][j];
  }
  Square<Linear, 3> out = cofactors(sum);
  const Linear over = inverse_determinant(sum, out);
  for (auto& row : out)
    for (Linear& x : row) x = over * x;
  return out;
}

using Row = std::array<Linear, six>;

/// A row for the columns of a basis.
Row in_basis(const Row& row, const Square<double, six>& basis) {
  Row out;
  for (std::size_t i = 0; i < six; ++i)
    for (std::size_t j = 0; j < six; ++j)
      if (basis[j][i] != 0.0) out[i] = out[i] + basis[j][i] * row[j];
  return out;
}

/// The squares of the rates of all nine legs for the twist t = (l_c w, v) of the platform, O free: t^T S t. The
/// singular values of the map from rates to twists are the inverse roots of the eigenvalues of S. Here B^T S B of a
/// basis B.
Square<Linear, six> stiffness(const Mount& m, const Stand& at, double length, int locked,
                              const Square<double, six>& basis) {
  const Linear over = inverse(length);
  Square<Linear, six> out;
  Square<Linear, 3> upper, lower;
  for (int leg = 0; leg < 3; ++leg) {
    const LegLine l = leg_line(m, at, leg);
    const Arrow e = unit(l.along()), moment = over * cross(l.to - at.p, e);
    const Row row = in_basis({moment.x, moment.y, moment.z, e.x, e.y, e.z}, basis);
    for (std::size_t i = 0; i < six; ++i)
      for (std::size_t j = 0; j <= i; ++j) out[i][j] = out[i][j] + row[i] * row[j];
    add_outer(unit(leg_line(m, at, 3 + leg).along()), upper);
    add_outer(unit(leg_line(m, at, 6 + leg).along()), lower);
  }
  // The platform's point at O moves by w x y + v.
  const Arrow y = over * (at.s - at.p);
  const std::array<Row, 3> k{in_basis({0.0, y.z, -y.y, 1.0, 0.0, 0.0}, basis),
                             in_basis({-y.z, 0.0, y.x, 0.0, 1.0, 0.0}, basis),
                             in_basis({y.y, -y.x, 0.0, 0.0, 0.0, 1.0}, basis)};
  const Square<Linear, 3> w = locked < 0 ? parallel_sum(upper, lower) : parallel_sum(m, at, locked);
  for (std::size_t j = 0; j < six; ++j) {
    std::array<Linear, 3> column;
    for (std::size_t a = 0; a < 3; ++a) column[a] = w[a][0] * k[0][j] + w[a][1] * k[1][j] + w[a][2] * k[2][j];
    for (std::size_t i = j; i < six; ++i)
      out[i][j] = out[i][j] + k[0][i] * column[0] + k[1][i] * column[1] + k[2][i] * column[2];
  }
  return out;
}

/// Eigenvectors, as columns of `v`, by Jacobi's rotations: nothing of them is believed.
void diagonalize(Square<double, six>& s, Square<double, six>& v) {
  for (std::size_t i = 0; i < six; ++i)
    for (std::size_t j = 0; j < six; ++j) v[i][j] = i == j ? 1.0 : 0.0;
  for (int sweep = 0; sweep < 12; ++sweep)
    for (std::size_t p = 0; p < six; ++p)
      for (std::size_t q = p + 1; q < six; ++q) {
        if (!(s[p][q] * s[p][q] > 0.0)) continue;  // the square is divided by
        const double half = 0.5 * (s[p][p] - s[q][q]), most = std::sqrt(half * half + s[p][q] * s[p][q]);
        const double tangent = s[p][q] / (half + (half < 0.0 ? -most : most));
        const double c = 1.0 / std::sqrt(1.0 + tangent * tangent), d = tangent * c;
        const auto turn = [&](double& x, double& y) {
          const double old = x;
          x = c * old + d * y;
          y = c * y - d * old;
        };
        for (auto& row : s) turn(row[p], row[q]);
        for (std::size_t k = 0; k < six; ++k) turn(s[p][k], s[q][k]);
        for (auto& row : v) turn(row[p], row[q]);
      }
}

/// Cholesky's decomposition runs to its end although more than its rounding was taken from the diagonal.
bool decomposes(Square<double, six> a) {
  double trace = 0.0;
  for (std::size_t i = 0; i < six; ++i) trace += std::abs(a[i][i]);
  for (std::size_t i = 0; i < six; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j] - (i == j ? 0x1p-46 * trace + grain::least : 0.0);
      for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      if (i > j) a[i][j] = sum / a[j][j];
      else if (!(sum > 0.0)) return false;
      else a[i][i] = std::sqrt(sum);
    }
  return true;
}

/// Symmetric matrices over a box.
class Matrices {
 public:
  explicit Matrices(Square<Linear, six> a) : a_(a) {
    for (std::size_t k = 0; k < symbols; ++k)
      for (std::size_t i = 0; i < six * six; ++i)
        if (i % six <= i / six && a_[i / six][i % six].a[k] != 0.0) {
          moving_.push_back(k);
          break;
        }
    for (std::size_t i = 0; i < six; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        const Linear& x = a_[i][j];
        const double error = (x.r + grain::of_product * (std::abs(x.c) + swing(x))) * grain::up;
        errors_[i] += error;
        if (i != j) errors_[j] += error;
      }
  }
  /// Whether that at a point is positive definite, less the errors of its rows.
  bool positive_at(const std::array<double, symbols>& t) const {
    Square<double, six> at{};
    for (std::size_t i = 0; i < six; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        at[i][j] = a_[i][j].c;
        for (const std::size_t k : moving_) at[i][j] += a_[i][j].a[k] * t[k];
        if (i == j) at[i][i] -= errors_[i] * grain::up;
      }
    return decomposes(at);
  }
  /// Whether all are: those at the corners.
  bool positive_everywhere() const {
    std::array<double, symbols> t{};
    for (unsigned corner = 0; corner < 1U << moving_.size(); ++corner) {
      for (std::size_t k = 0; k < moving_.size(); ++k) t[moving_[k]] = (corner >> k & 1U) != 0U ? 1.0 : -1.0;
      if (!positive_at(t)) return false;
    }
    return true;
  }

 private:
  Square<Linear, six> a_;
  std::vector<std::size_t> moving_;
  Vector6 errors_{};
};

/// mu - S and K^2 S - mu for some mu, which may change along the box: where both are positive definite, kappa <= K.
/// They are seen in the eigenvectors of the middle, each as long as makes S nearly one: there the errors of soft
/// directions are small.
struct Test {
  bool known = false;
  Square<Linear, six> s, one;  ///< B^T S B and B^T B of the basis B
  Linear k2, mu, excess;  ///< where the excess is negative, kappa > K
  Square<Linear, six> below() const {
    Square<Linear, six> out;
    for (std::size_t i = 0; i < six; ++i)
      for (std::size_t j = 0; j <= i; ++j) out[i][j] = mu * one[i][j] - s[i][j];
    return out;
  }
  Square<Linear, six> above() const {
    Square<Linear, six> out;
    for (std::size_t i = 0; i < six; ++i)
      for (std::size_t j = 0; j <= i; ++j) out[i][j] = k2 * s[i][j] - mu * one[i][j];
    return out;
  }
};
Test test_of(const Mount& m, const Stand& at, double length, double most, int locked) {
  Square<double, six> middle{}, basis{};
  for (std::size_t i = 0; i < six; ++i) basis[i][i] = 1.0;
  const Square<Linear, six> as_it_is = stiffness(m, at, length, locked, basis);
  for (std::size_t i = 0; i < six; ++i)
    for (std::size_t j = 0; j <= i; ++j) middle[i][j] = middle[j][i] = as_it_is[i][j].c;
  diagonalize(middle, basis);
  Test out;
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0; i < six; ++i) {
    if (!(middle[i][i] > 0.0)) return out;
    if (middle[i][i] < middle[first][first]) first = i;
    if (middle[i][i] > middle[last][last]) last = i;
    for (auto& row : basis) row[i] /= std::sqrt(middle[i][i]);
  }
  out.s = stiffness(m, at, length, locked, basis);
  for (std::size_t i = 0; i < six; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      for (const auto& row : basis) out.one[i][j] = out.one[i][j] + Linear(row[i]) * row[j];
  const Linear &least = out.s[first][first], &greatest = out.s[last][last];
  out.known = true;
  out.k2 = Linear(most) * most;
  out.excess = out.k2 * least * out.one[last][last] - greatest * out.one[first][first];
  out.mu = 0.5 * (middle[last][last] * greatest + out.k2 * (middle[first][first] * least));
  out.mu.r = 0.0;
  return out;
}

}  // namespace

int condition_within(const Mount& m, const Stand& at, double length, double most, int locked) {
  const Test test = test_of(m, at, length, most, locked);
  if (!test.known) return 0;
  if (upper_end(test.excess) < 0.0) return -1;
  return Matrices(test.below()).positive_everywhere() && Matrices(test.above()).positive_everywhere() ? 1 : 0;
}

std::vector<Point> corners_beyond(const Point& slope, double level) {
  const auto excess = [&](const Point& t) { return slope[0] * t[0] + slope[1] * t[1] + slope[2] * t[2] - level; };
  std::vector<Point> out;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Point t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = (corner >> k & 1U) != 0U ? 1.0 : -1.0;
    const double here = excess(t);
    if (here >= 0.0) out.push_back(t);
    for (std::size_t k = 0; k < 3; ++k) {
      Point other = t;
      other[k] = 1.0;
      if (const double there = excess(other); t[k] < 0.0 && (here >= 0.0) != (there >= 0.0)) {
        other[k] = std::clamp(-1.0 + 2.0 * here / (here - there), -1.0, 1.0);
        out.push_back(other);
      }
    }
  }
  return out;
}

/// Matrices that are linear are positive definite where they are at the corners of a body: a plane behind that where
/// the excess is 0 moves on until both are so at all corners of the part beyond it.
Sides condition_sides(const Mount& m, const Stand& at, double length, double most, int locked) {
  constexpr int tries = 10;
  constexpr double wider = 1.6;
  Sides out{{unknown_number()}, {unknown_number()}};
  const Test test = test_of(m, at, length, most, locked);
  if (!test.known) return out;
  const Linear& x = test.excess;
  out.breaks = {x};
  const Matrices below(test.below()), above(test.above());
  if (x.c > 0.0 && below.positive_everywhere() && above.positive_everywhere()) return {{}, {}};
  const Point slope{x.a[0], x.a[1], x.a[2]};
  const double all = swing(x);
  double step = 0.5 * x.r + 1e-9 * all, level = step - x.c;
  if (level < -all) {
    step = 0.1 * all;
    level = step - all;
  }
  for (int n = 0; n < tries && level < all; ++n, step *= wider, level += step) {
    const std::vector<Point> corners = corners_beyond(slope, level);
    const bool kept = std::ranges::all_of(corners, [&](const Point& t) {
      const std::array<double, symbols> there{t[0], t[1], t[2]};
      return below.positive_at(there) && above.positive_at(there);
    });
    if (!kept || corners.empty()) continue;
    Linear plane = x;
    plane.c = -level;
    plane.r = 1e-9 * all;  // of the corners
    out.keeps = {plane};
    break;
  }
  return out;
}

}  // namespace ninedof::checker::sets
