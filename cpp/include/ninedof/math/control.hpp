#pragma once
/// How a caller stops a long call and follows its progress.

#include <functional>
#include <stop_token>

namespace ninedof {

struct Control {
  std::stop_token stop;  ///< a stop is noticed within a fraction of a second
  /// (done, total as far as it is known, value): `value` is the best objective or the volume so far, NaN where there is
  /// none. Called from one thread at a time, which need not be the caller's. What it throws ends the call and reaches
  /// the caller.
  std::function<void(long done, long total, double value)> progress;
};

/// Thrown on a stop by a call that has no partial result to return.
struct Stopped {};

}  // namespace ninedof
