#pragma once
/// A stop that a clock gives too.

#include <thread>

#include "ninedof/math/control.hpp"

namespace ninedof {

/// Passes on the stop of a caller, and stops after some seconds. An infinite time starts no thread.
class TimeLimit {
 public:
  TimeLimit(double seconds, const std::stop_token& caller);
  std::stop_token stop() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::stop_callback<std::function<void()>> forward_;
  std::jthread clock_;
};

}  // namespace ninedof
