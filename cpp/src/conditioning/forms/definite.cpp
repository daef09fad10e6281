/// Where in a box the condition number is at most K, and where it is not. Declared in conditioning/forms/gram.hpp.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "conditioning/forms/gram.hpp"
#include "conditioning/forms/positive_definite.hpp"
#include "math/linear/jacobi_svd.hpp"

namespace ninedof::forms {
namespace {

/// t - above and K^2 M^T M - t for one number t that is linear in the box, the second as a matrix of nine rows: where
/// both are positive definite, the condition number is at most K. Both are linear in the box up to an error, so that
/// what holds at points holds in their hull.
template <class T>
class LinearTest {
 public:
  static constexpr std::size_t size = T::size;
  LinearTest(const SplitGramOf<T>& g, double condition)
      : g_(g), condition_(condition * (1.0 - 0x1p-51)), squared_(condition_ * condition_ * (1.0 - 0x1p-51)) {
    if (!g.known) return;
    double largest = 0.0;
    const auto seen = [&](const T& x) {
      largest = std::max(largest, std::abs(x.c) + spread(x));
      return x.r;
    };
    std::array<double, 6> above{};  // row sums of what the forms leave open
    std::array<double, 9> below{};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) above[i] += seen(g.above[entry(i, j)]);
    for (std::size_t i = 0; i < 6; ++i) below[i] = squared_ * above[i];
    for (std::size_t b = 0; b < 3; ++b) {
      // 2 |x w| is at most share x^2 + w^2 / share: the rows of w have more to spare.
      constexpr double share = 0.25;
      for (std::size_t i = 0; i < 6; ++i) {
        const double error = condition_ * seen(g.across[b][i]);
        below[i] += share * error;
        below[6 + b] += error / share;
      }
      for (std::size_t c = 0; c < 3; ++c) below[6 + b] += seen(g.sum[entry(b, c)]);
    }
    double open = 0.0;
    for (const double error : below) open += error;
    if (!(largest < 1e100 && open < 1e100)) return;
    const RightSvd<6> eigen = jacobi_right_svd(middle_of(g.above));
    const double most = eigen.sigma[0], least = eigen.sigma[5];
    known_ = true;
    holds_in_the_middle_ = most < squared_ * least;
    high_ = eigen.v.col(0);
    low_ = eigen.v.col(5);
    // t goes with the eigenvalues: t (box) = t + sum t_k t_k, between the greatest eigenvalue and K^2 times the least.
    const double share = 1.0 / (1.0 + condition);
    t_ = (1.0 - share) * most + share * squared_ * least;
    double slopes = 0.0;
    for (std::size_t k = 0; k < size; ++k) {
      Mat6 part;
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
          part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = g.above[entry(i, j)].a[k];
      bool moves = !part.isZero(0.0);
      for (std::size_t b = 0; b < 3; ++b) {
        for (const T& x : g.across[b]) moves = moves || x.a[k] != 0.0;
        for (const T& x : g.sum) moves = moves || x.a[k] != 0.0;
      }
      if (!moves) continue;
      slope_[count_] = (1.0 - share) * high_.dot(part * high_) + share * squared_ * low_.dot(part * low_);
      slopes += std::abs(slope_[count_]);
      active_[count_++] = k;
    }
    // Rounding of the points and of the decomposition, far below what a box leaves open.
    const double rounding = 0x1p-43 * ((1.0 + squared_) * largest + std::abs(t_) + slopes);
    for (std::size_t i = 0; i < 6; ++i) room_above_[i] = above[i] * (1.0 + 0x1p-48) + rounding;
    for (std::size_t i = 0; i < 9; ++i) room_below_[i] = below[i] * (1.0 + 0x1p-48) + rounding;
  }

  bool known() const { return known_; }
  bool holds_in_the_middle() const { return known_ && holds_in_the_middle_; }
  /// Eigenvectors of the middle.
  const Vec6& high() const { return high_; }
  const Vec6& low() const { return low_; }

  bool holds_at(const std::array<double, size>& at) const {
    const auto value = [&](const T& f) {
      double out = f.c;
      for (std::size_t k = 0; k < count_; ++k) out += at[active_[k]] * f.a[active_[k]];
      return out;
    };
    double shift = t_;
    for (std::size_t k = 0; k < count_; ++k) shift += at[active_[k]] * slope_[k];
    std::array<double, packed(6)> above;
    std::array<double, packed(9)> below;
    for (std::size_t n = 0; n < above.size(); ++n) {
      const double x = value(g_.above[n]);
      above[n] = -x;
      below[n] = squared_ * x;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      above[entry(i, i)] += shift;
      below[entry(i, i)] -= shift;
    }
    if (!positive_definite<6>(above, room_above_)) return false;
    for (std::size_t b = 0; b < 3; ++b) {
      for (std::size_t i = 0; i < 6; ++i) below[entry(6 + b, i)] = condition_ * value(g_.across[b][i]);
      for (std::size_t c = 0; c <= b; ++c) below[entry(6 + b, 6 + c)] = value(g_.sum[entry(b, c)]);
    }
    return positive_definite<9>(below, room_below_);
  }

  /// At every corner of the coordinates that move and are not among the `cuts`, those from `first_cut` on being `cut`.
  bool holds_for(const Slope<ConditionSplitOf<T>::cuts>& cut) const {
    constexpr std::size_t first = ConditionSplitOf<T>::first_cut;
    std::array<double, size> at{};
    std::copy(cut.begin(), cut.end(), at.begin() + first);
    std::array<std::size_t, size> others{};
    std::size_t n = 0;
    for (std::size_t k = 0; k < count_; ++k)
      if (active_[k] < first || active_[k] >= first + cut.size()) others[n++] = active_[k];
    for (std::size_t corner = 0; corner < (std::size_t{1} << n); ++corner) {
      for (std::size_t k = 0; k < n; ++k) at[others[k]] = (corner >> k) % 2 == 0 ? -1.0 : 1.0;
      if (!holds_at(at)) return false;
    }
    return true;
  }
  /// Of points that differ by a coordinate that moves nothing, neither the matrix nor the plane, one is enough.
  bool holds_for(const std::vector<Slope<ConditionSplitOf<T>::cuts>>& all,
                 const Slope<ConditionSplitOf<T>::cuts>& plane) const {
    const auto repeats = [&](const auto& cut) {
      for (std::size_t k = 0; k < cut.size(); ++k)
        if (cut[k] > 0.0 && plane[k] == 0.0 && !moves(ConditionSplitOf<T>::first_cut + k)) return true;
      return false;
    };
    return std::ranges::all_of(all, [&](const auto& cut) { return repeats(cut) || holds_for(cut); });
  }
  bool moves(std::size_t coordinate) const {
    return std::find(active_.begin(), active_.begin() + static_cast<std::ptrdiff_t>(count_), coordinate) !=
           active_.begin() + static_cast<std::ptrdiff_t>(count_);
  }
  bool holds_everywhere() const {
    for (std::size_t corner = 0; corner < (std::size_t{1} << count_); ++corner) {
      std::array<double, size> at{};
      for (std::size_t k = 0; k < count_; ++k) at[active_[k]] = (corner >> k) % 2 == 0 ? -1.0 : 1.0;
      if (!holds_at(at)) return false;
    }
    return true;
  }

 private:
  const SplitGramOf<T>& g_;
  double condition_, squared_, t_ = 0.0;
  bool known_ = false, holds_in_the_middle_ = false;
  Vec6 high_, low_;
  std::array<std::size_t, size> active_{};
  std::array<double, size> slope_{};
  std::size_t count_ = 0;
  std::array<double, 6> room_above_{};
  std::array<double, 9> room_below_{};
};

/// v^T G v.
template <class T>
T quadratic(const Symmetric6Of<T>& g, const Vec6& v) {
  T out;
  for (std::size_t i = 0; i < 6; ++i) {
    T row;
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

/// A number below the least eigenvalue of the matrix in all of the box; 0 where none is found.
template <class T>
double least_eigenvalue(const Symmetric3Of<T>& s) {
  Mat3 middle;
  std::array<double, packed(3)> entries;
  std::array<double, 3> room{};
  double largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const T& x = s[entry(i, j)];
      middle(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = x.c;
      entries[entry(i, j)] = x.c;
      room[i] += radius(x);
      largest = std::max(largest, std::abs(x.c));
    }
  if (!(largest < 1e100)) return 0.0;
  const double found = 0.99 * (Eigen::SelfAdjointEigenSolver<Mat3>(middle, Eigen::EigenvaluesOnly).eigenvalues()[0] -
                               *std::ranges::max_element(room)) -
                       0x1p-40 * largest;
  if (!(found > 0.0)) return 0.0;
  for (double& x : room) x += found + 0x1p-43 * largest;
  return positive_definite<3>(entries, room) ? found : 0.0;
}

/// A number below v^T M^T M v: what the minimum over w takes from `above`, or the part of the external legs.
template <class T>
T quadratic_from_below(const SplitGramOf<T>& g, const Vec6& v) {
  const double least = least_eigenvalue(g.sum);
  if (!(least > 0.0)) return quadratic(g.external, v);
  T taken;
  for (const std::array<T, 6>& row : g.across) {
    T x;
    for (std::size_t i = 0; i < 6; ++i) x = x + v[static_cast<Eigen::Index>(i)] * row[i];
    taken = taken + x * x;
  }
  return quadratic(g.above, v) - T::of(Interval(1.0) / Interval(least)) * taken;
}

}  // namespace

namespace {

/// Above K where it is positive.
template <class T>
T excess_of(const SplitGramOf<T>& g, double condition, const Vec6& high, const Vec6& low) {
  const Interval squared = square(Interval(condition));
  return T::of(squared_length(low)) * quadratic_from_below(g, high) -
         T::of(squared * squared_length(high)) * quadratic(g.above, low);
}

}  // namespace

template <class T>
T condition_excess(const SplitGramOf<T>& g, double condition) {
  if (!g.known) return T::unknown();
  const Mat6 middle = middle_of(g.above);
  if (!middle.allFinite()) return T::unknown();
  const RightSvd<6> eigen = jacobi_right_svd(middle);
  return excess_of(g, condition, eigen.v.col(0), eigen.v.col(5));
}

template <class T>
ConditionSplitOf<T> split_by_condition(const SplitGramOf<T>& g, double condition) {
  using Split = ConditionSplitOf<T>;
  constexpr double wider = 1.6;
  constexpr int tries = 9;
  Split out;
  out.level = std::numeric_limits<double>::infinity();
  out.excess = T::unknown();
  const LinearTest<T> test(g, condition);
  if (!test.known()) return out;
  out.excess = excess_of(g, condition, test.high(), test.low());
  if (!std::isfinite(radius(out.excess))) return out;
  for (std::size_t k = 0; k < Split::cuts; ++k) out.slope[k] = -out.excess.a[Split::first_cut + k];
  double others = 0.0;  // how far the excess goes by coordinates that are not cut
  for (std::size_t k = 0; k < T::size; ++k)
    if (k < Split::first_cut || k >= Split::first_cut + Split::cuts) others += std::abs(out.excess.a[k]);
  const double most = reach(out.slope);
  if (!(most > 0.0)) {
    out.everywhere = test.holds_in_the_middle() && test.holds_everywhere();
    return out;
  }
  if (-out.excess.c > most + others && test.holds_everywhere()) {
    out.everywhere = true;
    return out;
  }
  // A plane behind that where the excess vanishes, moved away from it until the test holds at all points of its hull.
  double step = 0.5 * out.excess.r + 1e-9 * most, level = out.excess.c + others + step;
  if (level < -most) {
    step = 0.1 * most;
    level = step - most;
  }
  for (int n = 0; n < tries && level < most; ++n, step *= wider, level += step) {
    const auto points = hull_above<Split::cuts>(out.slope, level);
    if (!test.holds_for(points, out.slope)) continue;
    if (!points.empty()) out.level = level;
    break;
  }
  return out;
}

template DesignForm condition_excess(const SplitGramOf<DesignForm>&, double);
template CurvedForm condition_excess(const SplitGramOf<CurvedForm>&, double);
template ConditionSplitOf<PoseForm> split_by_condition(const SplitGram&, double);
template ConditionSplitOf<DesignForm> split_by_condition(const SplitGramOf<DesignForm>&, double);

}  // namespace ninedof::forms
