#include "proof/nonplanar/line_reason.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof::proof {

void append_mixture(Bytes& out, const std::array<HermitianSum, 4>& sums,
                    const std::vector<std::pair<std::size_t, double>>& limits) {
  std::array<float, 14> entries{};  // of L, whose L L* are the sums
  std::size_t count = 0;
  const auto add = [&](double x) {
    const auto entry = static_cast<float>(x);
    entries[count++] = entry;
    return static_cast<double>(entry);
  };
  for (std::size_t n = 0; n < sums.size(); ++n) {
    const auto& [m11, re, im, m22] = sums[n];
    const double first = add(std::sqrt(m11)), share = first > 0.0 ? 1.0 / first : 0.0, left = share * share;
    add(share * re);
    if (n % 2 == 1) add(share * im);
    add(std::sqrt(std::max(m22 - left * (re * re + im * im), 0.0)));
  }
  unsigned given = 0;
  for (std::size_t k = 0; k < entries.size(); ++k) given |= entries[k] != 0.0F ? 1U << k : 0U;
  for (const unsigned byte : {given, given >> 8U}) out.push_back(static_cast<std::uint8_t>(byte));
  for (const float entry : entries)
    if (entry != 0.0F) append(out, entry);
  out.push_back(static_cast<std::uint8_t>(limits.size()));
  for (const auto& [limit, weight] : limits) {
    out.push_back(static_cast<std::uint8_t>(limit));
    append(out, static_cast<float>(weight));
  }
}

}  // namespace ninedof::proof
