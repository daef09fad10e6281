#pragma once
/// Long loops that Ctrl-C can leave.

#include <pybind11/pybind11.h>

#include <algorithm>
#include <chrono>

#include "ninedof/math/parallel.hpp"

namespace ninedof::python {

namespace py = pybind11;

/// Calls work(first, last) on blocks of [0, count) of at most `block` each, on `threads` threads, without the GIL. Python's
/// signals are looked at between slices, whose length is fitted to some 30 ms; other threads start only where they pay.
template <class Work>
void in_slices(long count, long block, int threads, const Work& work) {
  using Clock = std::chrono::steady_clock;
  constexpr double slice_seconds = 0.03, worth_a_thread = 0.5e-3;
  const long most = std::max(1L, count);
  long length = std::min(block, most);
  int workers = 1;
  for (long first = 0; first < count;) {
    const long last = std::min(count, first + length);
    const auto start = Clock::now();
    {
      const py::gil_scoped_release nogil;
      parallel_for(last - first, block, workers, [&](long a, long b) { work(first + a, first + b); });
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const double each = std::max(seconds / static_cast<double>(last - first), 1e-10);
    first = last;
    if (first < count && PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (workers == 1 && each * static_cast<double>(count - first) > worth_a_thread) workers = thread_count(threads);
    const double fitting = std::min(slice_seconds / each, static_cast<double>(most));
    length = std::clamp(static_cast<long>(fitting), std::min(block, most), std::max(2 * length, block * workers));
  }
}

}  // namespace ninedof::python
