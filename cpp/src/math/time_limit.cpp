#include "math/time_limit.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace ninedof {

TimeLimit::TimeLimit(double seconds, const std::stop_token& caller)
    : forward_(caller, [this] { source_.request_stop(); }) {
  constexpr double for_ever = 1e8, at_once = 1e-4;
  if (!(seconds < for_ever)) return;
  if (seconds < at_once) {  // before a thread would begin
    source_.request_stop();
    return;
  }
  clock_ = std::jthread([this, seconds](const std::stop_token& stop) {
    std::mutex guard;
    std::unique_lock lock(guard);
    std::condition_variable_any changed;
    if (changed.wait_for(lock, stop, std::chrono::duration<double>(seconds), [] { return false; })) return;
    if (!stop.stop_requested()) source_.request_stop();
  });
}

}  // namespace ninedof
