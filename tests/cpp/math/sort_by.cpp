/// sort_by.hpp: the order of items by a number.

#include "math/sort_by.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace ninedof;

TEST_SUITE("sort_by") {
  TEST_CASE("items are in the order of their keys, equal ones in the order they had") {
    struct Item {
      double key;
      std::unique_ptr<std::string> name;  // moved, not copied
    };
    std::vector<Item> items;
    for (const auto& [key, name] : {std::pair{2.0, "a"}, {-1.0, "b"}, {2.0, "c"}, {0.0, "d"}, {-0.0, "e"}})
      items.push_back({key, std::make_unique<std::string>(name)});
    const auto names = [&] {
      std::string out;
      for (const Item& item : items) out += *item.name;
      return out;
    };
    sort_by(items, &Item::key);
    CHECK(names() == "bdeac");
    sort_by(items, [](const Item& item) { return -item.key; });
    CHECK(names() == "acdeb");
  }
}
