#pragma once
/// Stable sorting by a number, compiled once: std::stable_sort is compiled anew for every type, half a second each.

#include <functional>
#include <utility>
#include <vector>

namespace ninedof {

/// The indices of keys from the least to the greatest, those of equal ones in their order.
std::vector<std::size_t> order_of(const std::vector<double>& keys);

/// Sorts by what `key` says of an item, the least first; it may be a member.
template <class T, class Key>
void sort_by(std::vector<T>& items, const Key& key) {
  std::vector<double> keys;
  for (const T& item : items) keys.push_back(std::invoke(key, item));
  std::vector<T> sorted;
  sorted.reserve(items.size());
  for (const std::size_t n : order_of(keys)) sorted.push_back(std::move(items[n]));
  items = std::move(sorted);
}

}  // namespace ninedof
