#include "ninedof/math/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace ninedof {

int thread_count(int threads) {
  if (threads > 0) return threads;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void parallel_for(long count, long block, int threads, const std::function<void(long, long)>& work) {
  const long blocks = (count + block - 1) / block;
  const int workers = static_cast<int>(std::min<long>(thread_count(threads), blocks));
  std::atomic<long> next{0};
  std::exception_ptr failure;
  std::mutex failure_guard;
  const auto run = [&] {
    try {
      for (long k = next++; k < blocks; k = next++) work(k * block, std::min(count, (k + 1) * block));
    } catch (...) {
      const std::lock_guard lock(failure_guard);
      if (!failure) failure = std::current_exception();
      next = blocks;
    }
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < workers; ++k) others.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ninedof
