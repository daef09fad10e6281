/// parallel.hpp: every item once with any number of threads; exceptions are rethrown.

#include "ninedof/math/parallel.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

using namespace ninedof;

TEST_SUITE("parallel") {
  TEST_CASE("every item is visited exactly once, in blocks of at most the given length") {
    for (const long count : {0L, 1L, 2L, 7L, 100L, 1001L})
      for (const long block : {1L, 3L, 64L, 5000L})
        for (const int threads : {0, 1, 2, 3, 8}) {
          std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
          std::atomic<bool> too_long = false;
          parallel_for(count, block, threads, [&](long first, long last) {
            if (last - first > block || last <= first) too_long = true;
            for (long k = first; k < last; ++k) ++visits[static_cast<std::size_t>(k)];
          });
          CHECK_FALSE(too_long);
          CHECK(std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n == 1; }));
        }
  }

  TEST_CASE("an exception in any thread ends the loop and is rethrown") {
    for (const int threads : {1, 2, 4}) {
      std::atomic<int> calls = 0;
      const auto work = [&](long first, long) {
        ++calls;
        if (first == 5) throw std::runtime_error("item 5");
      };
      CHECK_THROWS_WITH_AS(parallel_for(100'000, 1, threads, work), "item 5", std::runtime_error);
      CHECK(calls < 100'000);
    }
  }

  TEST_CASE("thread_count: the given number, else at least one") {
    CHECK(thread_count(3) == 3);
    CHECK(thread_count(0) >= 1);
    CHECK(thread_count(-1) >= 1);
  }
}
