#include "math/box_share.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof::forms {
namespace {

/// Coordinates whose slope is below this part of the greatest are taken for an uncertainty of the level: where two of
/// them divided, rounding would be larger than what is lost so.
constexpr double worth_a_division = 1e-3;

/// More than a sum of up to six products of slopes and coordinates loses in rounding, relative to what `reach`
/// gives.
constexpr double plane_rounding = 0x1p-48;

/// The volume of the x in [0, 1]^n with sum a_k x_k < level, for positive a: by inclusion and exclusion, the simplex
/// below the plane less those beyond the faces, (level - sum of a_k in S)_+^n / (n! a_1 ... a_n) with alternating
/// signs.
Interval simplex_sum(const std::array<double, 3>& a, std::size_t n, const Interval& level) {
  Interval sum;
  for (std::size_t set = 0; set < (std::size_t{1} << n); ++set) {
    Interval beyond = level;
    int sign = 1;
    for (std::size_t k = 0; k < n; ++k)
      if ((set >> k) % 2 == 1) {
        beyond -= a[k];
        sign = -sign;
      }
    beyond = max(beyond, 0.0);
    Interval power = beyond;
    for (std::size_t k = 1; k < n; ++k) power = power * beyond;
    sum = sign > 0 ? sum + power : sum - power;
  }
  Interval below = n == 3 ? 6.0 : n == 2 ? 2.0 : 1.0;
  for (std::size_t k = 0; k < n; ++k) below = below * a[k];
  return sum / below;
}

}  // namespace

template <std::size_t N>
double reach(const Slope<N>& slope) {
  double sum = 0.0;
  for (const double one : slope) sum += std::abs(one);
  return sum * (1.0 + 0x1p-50);
}

Interval share_below(const Slope3& slope, double level) {
  const double most = reach(slope);
  if (!(std::isfinite(most) && !std::isnan(level))) return {0.0, 1.0};
  if (level > most) return 1.0;
  if (level < -most) return 0.0;
  // A power of two, which loses nothing, brings the greatest slope near 1.
  const double largest = std::max({std::abs(slope[0]), std::abs(slope[1]), std::abs(slope[2])});
  if (!(largest > 1e-200)) return {0.0, 1.0};
  const int exponent = std::ilogb(largest);
  std::array<double, 3> a{};
  std::size_t n = 0;
  // slope . t = sum |slope_k| (2 x_k - 1), x_k from 0 to 1 after a reflection.
  Interval from_zero = std::ldexp(level, -exponent);
  for (const double one : slope) {
    const double size = std::ldexp(std::abs(one), -exponent);
    if (std::abs(one) >= worth_a_division * largest) {
      a[n++] = 2.0 * size;
      from_zero += size;
    } else {
      from_zero += Interval(-size, size);
    }
  }
  const Interval low = simplex_sum(a, n, from_zero.lo), high = simplex_sum(a, n, from_zero.hi);
  return {std::clamp(low.lo, 0.0, 1.0), std::clamp(high.hi, 0.0, 1.0)};
}

template <std::size_t N>
std::vector<Slope<N>> hull_above(const Slope<N>& slope, double level) {
  std::vector<Slope<N>> out;
  // A plane a little below: what the points of edges lose in rounding is less.
  const double lower = level - 4.0 * plane_rounding * (reach(slope) + std::abs(level));
  const auto value = [&](const Slope<N>& t) {
    double sum = slope[0] * t[0];
    for (std::size_t k = 1; k < N; ++k) sum += slope[k] * t[k];
    return sum;
  };
  for (std::size_t corner = 0; corner < (std::size_t{1} << N); ++corner) {
    Slope<N> t;
    for (std::size_t k = 0; k < N; ++k) t[k] = (corner >> k) % 2 == 0 ? -1.0 : 1.0;
    if (value(t) < lower) continue;
    out.push_back(t);
    for (std::size_t k = 0; k < N; ++k) {
      Slope<N> other = t;
      other[k] = -t[k];
      if (value(other) >= lower) continue;
      // From a corner above to one below: slope_k is not zero.
      other[k] = 0.0;
      other[k] = std::clamp((lower - value(other)) / slope[k], -1.0, 1.0);
      out.push_back(other);
    }
  }
  return out;
}

template double reach(const Slope<3>&);
template double reach(const Slope<6>&);
template std::vector<Slope<3>> hull_above(const Slope<3>&, double);
template std::vector<Slope<6>> hull_above(const Slope<6>&, double);

}  // namespace ninedof::forms
