#include "proof/region_gram.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear/jacobi_svd.hpp"

namespace ninedof::over_region {
namespace {

/// A symmetric matrix: xx, yx, yy, zx, zy, zz.
using Symmetric3 = std::array<Form, 6>;

const Form& at(const Symmetric3& s, std::size_t i, std::size_t j) {
  return s[entry(i, j)];
}

void add_square(Symmetric3& s, const Vector& v) {
  const std::array<const Form*, 3> x{&v.x, &v.y, &v.z};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j) s[entry(i, j)] = s[entry(i, j)] + *x[i] * *x[j];
}

Symmetric3 inverted(const Symmetric3& s) {
  const auto minor = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    return at(s, i, k) * at(s, j, l) - at(s, i, l) * at(s, j, k);
  };
  const Symmetric3 adjugate{minor(1, 2, 1, 2), -minor(0, 2, 1, 2), minor(0, 2, 0, 2),
                            minor(0, 1, 1, 2), -minor(0, 1, 0, 2), minor(0, 1, 0, 1)};
  const Form one_over = inverse(at(s, 0, 0) * adjugate[0] + at(s, 1, 0) * adjugate[1] + at(s, 2, 0) * adjugate[3]);
  Symmetric3 out;
  for (std::size_t k = 0; k < 6; ++k) out[k] = one_over * adjugate[k];
  return out;
}

/// H - H (H + F)^-1 H
Symmetric3 parallel(const Symmetric3& h, const Symmetric3& f) {
  Symmetric3 sum;
  for (std::size_t k = 0; k < 6; ++k) sum[k] = h[k] + f[k];
  const Symmetric3 x = inverted(sum);
  std::array<std::array<Form, 3>, 3> xh;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      xh[i][j] = at(x, i, 0) * at(h, 0, j) + at(x, i, 1) * at(h, 1, j) + at(x, i, 2) * at(h, 2, j);
  Symmetric3 out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      out[entry(i, j)] = at(h, i, j) - (at(h, i, 0) * xh[0][j] + at(h, i, 1) * xh[1][j] + at(h, i, 2) * xh[2][j]);
  return out;
}

}  // namespace

Symmetric6 gram(const PosedRobot& machine, const FormPose& pose, Slopes& moves) {
  const Geometry& g = machine.geometry;
  const double inverse_lc = 1.0 / machine.characteristic_length;
  const auto direction = [&](int k) {
    const Ends e = ends_of(g, pose, k);
    const Vector v = e.to - e.from, out = inverse_root(dot(v, v)) * v;
    moves.add(out);
    return out;
  };
  Symmetric6 out;
  Symmetric3 upper_legs, lower_legs;
  for (int i = 0; i < 3; ++i) {
    const Vector e = direction(i), u = turned(pose, g.platform_external()[static_cast<std::size_t>(i)]);
    const Vector m = inverse_lc * cross(u, e);
    const std::array<const Form*, 6> row{&m.x, &m.y, &m.z, &e.x, &e.y, &e.z};
    for (std::size_t j = 0; j < 6; ++j)
      for (std::size_t k = 0; k <= j; ++k) out[entry(j, k)] = out[entry(j, k)] + *row[j] * *row[k];
    add_square(upper_legs, direction(i + 3));
    add_square(lower_legs, direction(i + 6));
  }
  const Symmetric3 p = parallel(upper_legs, lower_legs);
  const Vector y = inverse_lc * (pose.s - pose.p);
  // Columns of K: e_k x y for turns, e_k for shifts.
  const Form zero = 0.0;
  const std::array<Vector, 3> turn{Vector{zero, -y.z, y.y}, Vector{y.z, zero, -y.x}, Vector{-y.y, y.x, zero}};
  std::array<Vector, 3> p_turn;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto row = [&](std::size_t i) {
      return at(p, i, 0) * turn[k].x + at(p, i, 1) * turn[k].y + at(p, i, 2) * turn[k].z;
    };
    p_turn[k] = {row(0), row(1), row(2)};
  }
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t k = 0; k <= j; ++k) {
      out[entry(j, k)] = out[entry(j, k)] + dot(turn[j], p_turn[k]);
      out[entry(j + 3, k + 3)] = out[entry(j + 3, k + 3)] + at(p, j, k);
    }
  for (std::size_t k = 0; k < 3; ++k) {
    out[entry(3, k)] = out[entry(3, k)] + p_turn[k].x;
    out[entry(4, k)] = out[entry(4, k)] + p_turn[k].y;
    out[entry(5, k)] = out[entry(5, k)] + p_turn[k].z;
  }
  return out;
}

Mat6 middle_of(const Symmetric6& g) {
  Mat6 out;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) out(i, j) = g[entry(static_cast<std::size_t>(i), static_cast<std::size_t>(j))].c;
  return out;
}

namespace {

using Entries = std::array<double, 21>;

/// Whether the symmetric matrix is positive definite, proved: its Cholesky decomposition runs to the end although more
/// than its rounding errors was taken from the diagonal (Rump, BIT 2006). `room`: what is taken, entry by entry.
bool positive_definite(const Entries& a, const std::array<double, 6>& room) {
  Entries l;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[entry(i, j)];
      if (i == j) sum -= room[i];
      for (std::size_t k = 0; k < j; ++k) sum -= l[entry(i, k)] * l[entry(j, k)];
      if (i > j) l[entry(i, j)] = sum * l[entry(j, j)];
      else if (!(sum > 0.0)) return false;
      else l[entry(i, i)] = 1.0 / std::sqrt(sum);
    }
  return true;
}

/// t - M^T M and K^2 M^T M - t for one number t that is linear in the box: where both are positive definite, the condition
/// number is at most K. Both matrices are linear in the box up to an error, so that what holds at points holds in their
/// hull.
class LinearTest {
 public:
  LinearTest(const Symmetric6& g, double condition) : g_(g), squared_(condition * condition * (1.0 - 0x1p-50)) {
    double largest = 0.0;
    std::array<double, 6> error{};  // row sums of what the forms leave open
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) {
        const Form& x = g[entry(i, j)];
        error[i] += x.r;
        largest = std::max(largest, std::abs(x.c) + spread(x));
      }
    if (!(largest < 1e100)) return;
    known_ = true;
    const RightSvd<6> eigen = jacobi_right_svd(middle_of(g));
    const double most = eigen.sigma[0], least = eigen.sigma[5];
    holds_in_the_middle_ = most < squared_ * least;
    high_ = eigen.v.col(0);
    low_ = eigen.v.col(5);
    // t goes with the eigenvalues: t (box) = t + sum t_k t_k, between the greatest eigenvalue and K^2 times the least.
    const double share = 1.0 / (1.0 + condition);
    t_ = (1.0 - share) * most + share * squared_ * least;
    double slopes = 0.0;
    for (std::size_t k = 0; k < form_size; ++k) {
      Mat6 part;
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
          part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = g[entry(i, j)].a[k];
      if (part.isZero(0.0)) continue;
      slope_[count_] = (1.0 - share) * high_.dot(part * high_) + share * squared_ * low_.dot(part * low_);
      slopes += std::abs(slope_[count_]);
      active_[count_++] = k;
    }
    // Rounding of the points and of the decomposition, far below what a box leaves open.
    const double rounding = 0x1p-43 * (squared_ * largest + std::abs(t_) + slopes);
    for (std::size_t i = 0; i < 6; ++i) {
      room_above_[i] = error[i] * (1.0 + 0x1p-48) + rounding;
      room_below_[i] = squared_ * error[i] * (1.0 + 0x1p-48) + rounding;
    }
  }

  bool known() const { return known_; }
  bool holds_in_the_middle() const { return known_ && holds_in_the_middle_; }
  /// Eigenvectors of the middle.
  const Vec6& high() const { return high_; }
  const Vec6& low() const { return low_; }

  bool holds_at(const std::array<double, form_size>& at) const {
    double shift = t_;
    Entries above, below;
    for (std::size_t n = 0; n < above.size(); ++n) above[n] = g_[n].c;
    for (std::size_t k = 0; k < count_; ++k) {
      const double t = at[active_[k]];
      shift += t * slope_[k];
      for (std::size_t n = 0; n < above.size(); ++n) above[n] += t * g_[n].a[active_[k]];
    }
    for (std::size_t n = 0; n < above.size(); ++n) {
      below[n] = squared_ * above[n];
      above[n] = -above[n];
    }
    for (std::size_t i = 0; i < 6; ++i) {
      above[entry(i, i)] += shift;
      below[entry(i, i)] -= shift;
    }
    return positive_definite(below, room_below_) && positive_definite(above, room_above_);
  }

  bool holds_everywhere() const {
    for (std::size_t corner = 0; corner < (std::size_t{1} << count_); ++corner) {
      std::array<double, form_size> at{};
      for (std::size_t k = 0; k < count_; ++k) at[active_[k]] = (corner >> k) % 2 == 0 ? -1.0 : 1.0;
      if (!holds_at(at)) return false;
    }
    return true;
  }

 private:
  const Symmetric6& g_;
  double squared_, t_ = 0.0;
  bool known_ = false, holds_in_the_middle_ = false;
  Vec6 high_, low_;
  std::array<std::size_t, form_size> active_{};
  std::array<double, form_size> slope_{};
  std::size_t count_ = 0;
  std::array<double, 6> room_above_{}, room_below_{};
};

/// v^T G v, and v^T v.
Form quadratic(const Symmetric6& g, const Vec6& v) {
  Form out;
  for (std::size_t i = 0; i < 6; ++i) {
    Form row;
    for (std::size_t j = 0; j < 6; ++j) row = row + v[static_cast<Eigen::Index>(j)] * g[entry(i, j)];
    out = out + v[static_cast<Eigen::Index>(i)] * row;
  }
  return out;
}
Interval squared_length(const Vec6& v) {
  Interval out;
  for (const double x : v) out += square(Interval(x));
  return out;
}

}  // namespace

bool bounded(const Symmetric6& g, double condition) {
  const LinearTest test(g, condition);
  return test.holds_in_the_middle() && test.holds_everywhere();
}

ConditionSplit split_by_condition(const Symmetric6& g, double condition) {
  constexpr double wider = 1.6, tries = 9;
  ConditionSplit out;
  out.level = std::numeric_limits<double>::infinity();
  out.excess = detail::unknown();
  const LinearTest test(g, condition);
  if (!test.known()) return out;
  const Interval squared = square(Interval(condition));
  out.excess = Form::of(squared_length(test.low())) * quadratic(g, test.high()) -
               Form::of(squared * squared_length(test.high())) * quadratic(g, test.low());
  for (std::size_t k = 0; k < 3; ++k) out.slope[k] = -out.excess.a[k];
  const double most = reach(out.slope);
  if (!(most > 0.0)) {
    out.everywhere = test.holds_in_the_middle() && test.holds_everywhere();
    return out;
  }
  if (-out.excess.c > most && test.holds_everywhere()) {
    out.everywhere = true;
    return out;
  }
  // A plane behind that where the excess vanishes, moved away from it until the test holds at all points of its hull.
  double step = 0.5 * out.excess.r + 1e-9 * most, level = out.excess.c + step;
  if (level < -most) {
    step = 0.1 * most;
    level = step - most;
  }
  for (int n = 0; n < tries && level < most; ++n, step *= wider, level += step) {
    const std::vector<Slope3> points = hull_above(out.slope, level);
    const bool all =
        std::ranges::all_of(points, [&](const Slope3& t) { return test.holds_at({t[0], t[1], t[2], 0.0, 0.0, 0.0}); });
    if (!all) continue;
    if (!points.empty()) out.level = level;
    break;
  }
  return out;
}

double condition_attained(const Symmetric6& g) {
  const Mat6 middle = middle_of(g);
  if (!middle.allFinite()) return 0.0;
  const RightSvd<6> eigen = jacobi_right_svd(middle);
  // The greatest eigenvalue is no less, the least no more, than the Rayleigh quotient of any vector.
  const auto quotient = [&](Eigen::Index column) {
    const Vec6 v = eigen.v.col(column);
    Interval sum, square_sum;
    for (std::size_t i = 0; i < 6; ++i) {
      const Interval x(v[static_cast<Eigen::Index>(i)]);
      square_sum += square(x);
      for (std::size_t j = 0; j < 6; ++j) {
        const Form& e = g[entry(i, j)];
        sum += Interval(lower(e), upper(e)) * (x * Interval(v[static_cast<Eigen::Index>(j)]));
      }
    }
    return sum / square_sum;
  };
  const Interval most = quotient(0), least = max(quotient(5), 0.0);
  return most.lo > 0.0 ? sqrt(most / Interval(least.hi)).lo : 0.0;
}

}  // namespace ninedof::over_region
