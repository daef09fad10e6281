#pragma once
/// A loop over independent items on several threads. The work must write its results by index: then they do not depend
/// on the number of threads.

#include <functional>

namespace ninedof {

/// `threads` if positive, else the number of processors.
int thread_count(int threads);

/// Calls work(first, last) on consecutive blocks of [0, count), each at most `block` long, from `threads` threads
/// (the calling one included). The first exception thrown by `work` is rethrown here.
void parallel_for(long count, long block, int threads, const std::function<void(long, long)>& work);

}  // namespace ninedof
