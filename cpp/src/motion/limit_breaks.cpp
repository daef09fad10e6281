#include "ninedof/motion/limit_breaks.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "limits/pose_row.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

/// Where the line between samples k and k + 1 is zero.
double zero(std::span<const double> time, std::span<const double> values, std::size_t k) {
  const double share = std::min(1.0, std::max(0.0, values[k] / (values[k] - values[k + 1])));
  return time[k] + share * (time[k + 1] - time[k]);
}

void append(std::vector<LimitBreak>& out, const std::vector<LimitBreak>& more) {
  out.insert(out.end(), more.begin(), more.end());
}

}  // namespace

std::vector<LimitBreak> stretches(const std::string& limit, std::span<const double> time,
                                  std::span<const double> values, std::span<const double> margin, double tolerance) {
  const std::size_t n = time.size();
  if (values.size() != n || margin.size() != n)
    throw InvalidArgument("values, margin", std::to_string(values.size()) + ", " + std::to_string(margin.size()),
                          std::to_string(n) + " each, one for each time");
  std::vector<LimitBreak> out;
  const auto passed = [&](double m) { return m < -tolerance; };
  for (auto first = std::ranges::find_if(margin, passed); first != margin.end();) {
    const auto after = std::find_if_not(first, margin.end(), passed);
    const auto begin = at_index(first - margin.begin()), end = at_index(after - margin.begin());
    const auto worst = at_index(std::min_element(first, after) - margin.begin());
    out.push_back({limit, begin == 0 ? time[0] : zero(time, margin, begin - 1),
                   end == n ? time[n - 1] : zero(time, margin, end - 1), values[worst], time[worst]});
    first = std::find_if(after, margin.end(), passed);
  }
  return out;
}

std::vector<LimitBreak> crossings(const std::string& name, std::span<const double> time,
                                  std::span<const double> determinant) {
  std::vector<LimitBreak> out;
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (determinant[k] == 0.0) out.push_back({name, time[k], time[k], 0.0, time[k]});
    if (k + 1 == time.size() || !(determinant[k + 1] * determinant[k] < 0.0)) continue;
    const double at = zero(time, determinant, k);
    out.push_back({name, at, at, 0.0, at});
  }
  return out;
}

LegMargins leg_margins(const Vec9& lengths, const LegLimits& limits) {
  const auto share = [](Side side) {
    return [side](double limit, double length) { return margin(LimitKind::length, side, limit, length); };
  };
  return {limits.low.binaryExpr(lengths, share(Side::low)), limits.high.binaryExpr(lengths, share(Side::high))};
}

std::vector<LimitBreak> limit_breaks(std::span<const double> time, std::span<const Vec9> lengths,
                                     const LegLimits& limits, std::span<const PerMechanism> determinants) {
  const std::size_t n = time.size();
  if (lengths.size() != n || determinants.size() != n)
    throw InvalidArgument("lengths, determinants",
                          std::to_string(lengths.size()) + ", " + std::to_string(determinants.size()),
                          std::to_string(n) + " each, one for each time");
  std::vector<LegMargins> margins;
  for (const Vec9& each : lengths) margins.push_back(leg_margins(each, limits));
  std::vector<double> length(n), low(n), high(n);
  std::vector<LimitBreak> out;
  for (int leg = 0; leg < 9; ++leg) {
    for (std::size_t k = 0; k < n; ++k) {
      length[k] = lengths[k][leg];
      low[k] = margins[k].low[leg];
      high[k] = margins[k].high[leg];
    }
    append(out, stretches(leg_name(leg) + std::string(" low"), time, length, low));
    append(out, stretches(leg_name(leg) + std::string(" high"), time, length, high));
  }
  for (const auto& [name, of] : {std::pair("det N", &PerMechanism::n), std::pair("det B", &PerMechanism::b),
                                 std::pair("det C", &PerMechanism::c)}) {
    std::vector<double> values;
    for (const PerMechanism& all : determinants) values.push_back(all.*of);
    append(out, crossings(name, time, values));
  }
  std::ranges::stable_sort(out, {}, [](const LimitBreak& b) { return std::tie(b.begin, b.limit); });
  return out;
}

}  // namespace ninedof
