/// Whether the condition number is at most K in all of a box. Declared in conditioning/forms/gram.hpp.

#include <algorithm>
#include <bit>
#include <cmath>

#include "conditioning/forms/gram.hpp"
#include "conditioning/forms/positive_definite.hpp"
#include "math/linear/jacobi_svd.hpp"

namespace ninedof::forms {
namespace {

template <std::size_t N>
using Packed = std::array<double, packed(N)>;

/// A symmetric matrix over a box: G_0 + sum t_k G_k + E, with |E| <= `open` entry by entry.
template <std::size_t N>
struct LinearMatrix {
  Packed<N> middle{}, open{};
  std::array<Packed<N>, PoseForm::size> slope{};

  /// Takes an entry; `error` is added to that of the form.
  void set(std::size_t n, const CurvedForm& x, double error) {
    middle[n] = x.c;
    open[n] = error + x.r;
    for (std::size_t k = 0, m = 0; k < CurvedForm::size; ++k, ++m) {
      slope[k][n] = x.a[k];
      for (std::size_t l = 0; l < k; ++l, ++m) open[n] += std::abs(x.q[m]);
      middle[n] += 0.5 * x.q[m];  // t_k^2 is 1/2 within 1/2
      open[n] += 0.5 * std::abs(x.q[m]);
    }
  }
  /// What |E| may take from the diagonal: sums of rows scaled by z. Rows that have `spare` to give take it from
  /// `critical`.
  std::array<double, N> room(std::size_t critical, const std::array<double, N>& spare) const {
    std::array<double, N> z, out;
    z.fill(1.0);
    for (int n = 0; n < 2; ++n)
      for (std::size_t i = 0; i < N; ++i) {
        if (i == critical) continue;
        double sum = 0.0;
        for (std::size_t j = 0; j < N; ++j)
          if (j != i) sum += open[entry(i, j)] * z[j];
        const double left = spare[i] - open[entry(i, i)];
        z[i] = sum < left ? std::max(sum / left, 1e-6) : 1.0;
      }
    for (std::size_t i = 0; i < N; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < N; ++j) sum += open[entry(i, j)] * z[j];
      out[i] = sum / z[i] * (1.0 + 0x1p-45);
    }
    return out;
  }
  /// Whether G - room is positive definite at all corners of the coordinates that move.
  bool positive(const std::array<double, N>& room, unsigned moving) const {
    std::array<std::size_t, PoseForm::size> active{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < PoseForm::size; ++k)
      if (moving >> k & 1U) active[count++] = k;
    Packed<N> at = middle;
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t n = 0; n < at.size(); ++n) at[n] -= slope[active[k]][n];
    // From corner to corner one coordinate changes its side.
    for (std::size_t corner = 0;;) {
      if (!positive_definite<N>(at, room)) return false;
      if (++corner >> count) return true;
      const auto k = static_cast<std::size_t>(std::countr_zero(corner));
      const double way = (corner ^ corner >> 1U) >> k & 1U ? 2.0 : -2.0;
      for (std::size_t n = 0; n < at.size(); ++n) at[n] += way * slope[active[k]][n];
    }
  }
};

/// x + k y, without rounding.
void add(CurvedForm& x, double k, const CurvedForm& y) {
  x.c += k * y.c;
  for (std::size_t i = 0; i < x.a.size(); ++i) x.a[i] += k * y.a[i];
  for (std::size_t i = 0; i < x.q.size(); ++i) x.q[i] += k * y.q[i];
  x.r += std::abs(k) * y.r;
}
double column(const Mat6& v, std::size_t i, std::size_t j) {
  return v(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

/// The test of the drawn machine from which that of all machines follows. With N z the rows of the legs and D z what
/// they change by,
///     (1 - b) |N z|^2 - (1 / b - 1) |D z|^2 <= |(N + D) z|^2 <= (1 + a) |N z|^2 + (1 + 1 / a) |D z|^2,
/// so that a smaller condition number is needed, and more room in the matrix of nine rows.
struct AllMachines {
  double condition, of_x = 0.0, of_w = 0.0;
};
AllMachines all_machines(const Looseness& loose, double condition, double most, double least) {
  if (loose.fixed == 0.0) return {condition};
  constexpr double up = 1.0 + 0x1p-40, down = 1.0 - 0x1p-40;
  constexpr double c = 0.2;  // (x + w)^2 <= (1 + c) x^2 + (1 + 1 / c) w^2
  const double a = loose.fixed / std::sqrt(most), b = loose.fixed / std::sqrt(least);
  if (!(b < 0.5)) return {0.0};
  const double x = loose.fixed * loose.fixed, w = loose.moved * loose.moved, taken = 1.0 / b - 1.0;
  return {condition * std::sqrt((1.0 - b) / (1.0 + a)) * down,
          ((1.0 + 1.0 / a) + condition * condition * taken * (1.0 + c)) * x / (1.0 + a) * up,
          taken * (1.0 + 1.0 / c) * w / (1.0 - b) * up};
}

}  // namespace

bool bounded(const SplitGramOf<CurvedForm>& g, double condition, const Looseness& loose) {
  constexpr double part_of_spare = 0.6;
  if (!g.known) return false;
  const RightSvd<6> eigen = jacobi_right_svd(forms::middle_of(g.above));
  const double most = eigen.sigma[0], least = eigen.sigma[5];
  const AllMachines all = all_machines(loose, condition * (1.0 - 0x1p-51), most, least);
  const double k = all.condition, squared = k * k * (1.0 - 0x1p-51);
  if (!(squared * least - most > 0.0)) return false;

  // All in the basis of the eigenvectors in the middle, without rounding.
  Symmetric6Of<CurvedForm> turned;
  std::array<std::array<CurvedForm, 6>, 3> across;
  double largest = 0.0;
  unsigned moving = 0;
  const auto seen = [&](const CurvedForm& x) {
    largest = std::max(largest, std::abs(x.c) + radius(x));
    for (std::size_t n = 0; n < CurvedForm::size; ++n)
      if (x.a[n] != 0.0) moving |= 1U << n;
  };
  for (const CurvedForm& x : g.above) seen(x);
  for (const CurvedForm& x : g.sum) seen(x);
  for (std::size_t b = 0; b < 3; ++b)
    for (const CurvedForm& x : g.across[b]) seen(x);
  if (!(largest < 1e100)) return false;
  for (std::size_t i = 0; i < 6; ++i) {
    std::array<CurvedForm, 6> times;
    for (std::size_t j = 0; j < 6; ++j)
      for (std::size_t l = 0; l < 6; ++l) add(times[j], column(eigen.v, l, i), g.above[entry(j, l)]);
    for (std::size_t j = 0; j <= i; ++j)
      for (std::size_t l = 0; l < 6; ++l) add(turned[entry(i, j)], column(eigen.v, l, j), times[l]);
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t l = 0; l < 6; ++l) add(across[b][i], k * column(eigen.v, l, i), g.across[b][l]);
  }

  // What the critical rows lose to others: to first order of their slopes, squared, and to what forms leave open.
  const auto slopes = [](const CurvedForm& x) {
    double out = 0.0;
    for (const double slope : x.a) out += std::abs(slope);
    return out;
  };
  const auto lost = [](double slope, double apart) {
    return slope > 0.0 ? slope * slope / std::max(apart, slope) : 0.0;
  };
  std::array<double, 6> spare_above{};
  std::array<double, 9> spare_below{};
  double lost_above = turned[entry(0, 0)].r, lost_below = squared * turned[entry(5, 5)].r + all.of_x;
  for (std::size_t i = 0; i < 6; ++i) {
    const double value = eigen.sigma[static_cast<Eigen::Index>(i)];
    spare_above[i] = part_of_spare * (most - value);
    spare_below[i] = part_of_spare * squared * (value - least);
    const double up = slopes(turned[entry(i, 0)]), down = slopes(turned[entry(i, 5)]);
    if (i != 0) lost_above += lost(up, most - value);
    if (i != 5) lost_below += squared * lost(down, value - least);
  }
  for (std::size_t b = 0; b < 3; ++b) {
    const double sum = g.sum[entry(b, b)].c, down = slopes(across[b][5]);
    spare_below[6 + b] = part_of_spare * 0.5 * sum;
    lost_below += lost(down, 0.5 * sum);
  }
  // t goes with the eigenvalues, between the greatest and K^2 times the least.
  const double share = std::clamp(lost_above / (lost_above + lost_below), 0.01, 0.99);
  CurvedForm t;
  add(t, 1.0 - share, turned[entry(0, 0)]);
  add(t, share * squared, turned[entry(5, 5)]);
  t.r = 0.0;
  const double defect = (eigen.v.transpose() * eigen.v - Mat6::Identity()).cwiseAbs().maxCoeff();
  // Of an entry: turning it, its values at corners and its part in the decomposition lose 200 units of 2^-53.
  const double rounding = 0x1p-44 * (1.0 + squared) * largest + 2.0 * defect * (std::abs(t.c) + spread(t) + all.of_x);

  LinearMatrix<6> above;
  LinearMatrix<9> below;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      CurvedForm up, down;
      add(up, -1.0, turned[entry(i, j)]);
      add(down, squared, turned[entry(i, j)]);
      if (i == j) {
        add(up, 1.0, t);
        add(down, -1.0, t);
      }
      above.set(entry(i, j), up, rounding);
      below.set(entry(i, j), down, rounding);
    }
  for (std::size_t b = 0; b < 3; ++b) {
    for (std::size_t i = 0; i < 6; ++i) below.set(entry(6 + b, i), across[b][i], rounding);
    for (std::size_t c = 0; c <= b; ++c) below.set(entry(6 + b, 6 + c), g.sum[entry(b, c)], rounding);
  }
  std::array<double, 9> room_below = below.room(5, spare_below);
  for (std::size_t i = 0; i < 9; ++i) room_below[i] += i < 6 ? all.of_x : all.of_w;
  return above.positive(above.room(0, spare_above), moving) && below.positive(room_below, moving);
}

}  // namespace ninedof::forms
