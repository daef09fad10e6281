#include "math/sort_by.hpp"

#include <algorithm>
#include <numeric>

namespace ninedof {

std::vector<std::size_t> order_of(const std::vector<double>& keys) {
  std::vector<std::size_t> out(keys.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  std::ranges::stable_sort(out, {}, [&](std::size_t n) { return keys[n]; });
  return out;
}

}  // namespace ninedof
