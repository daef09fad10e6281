#pragma once
/// Calls of the core that Ctrl-C can end: one long call with a stop token, or a loop over many short items.

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <type_traits>

#include "ninedof/math/control.hpp"
#include "support/without_gil.hpp"

namespace ninedof::python {

namespace py = pybind11;

/// What the work of `interruptible` is given.
struct WorkControl : Control {
  /// Runs a call on the thread that waits for the work, with the GIL, and returns after it; on a stop at once.
  std::function<void(const std::function<void()>&)> on_calling_thread;
};

/// Calls work(control) on a new thread and without the GIL. The calling thread meanwhile checks for signals and calls
/// `progress`, None or a Python callable, as progress(done, total, value) with None for a value of NaN. An exception of
/// `progress`, of what the work has run here, or of a signal handler stops the work and goes on to the caller. After
/// Ctrl-C, though, it ends as always where `mark` says that the result shows the interruption.
void run_interruptibly(const py::object& progress, const std::function<void(const WorkControl&)>& work,
                       const std::function<bool()>& mark);

/// Returns work(control), called as above. After Ctrl-C a result that can show the interruption is returned, also one
/// that was complete by then: mark(result) marks it and returns whether it could.
template <class Work, class Mark>
auto interruptible(const py::object& progress, const Work& work, const Mark& mark) {
  std::optional<std::invoke_result_t<Work, WorkControl>> result;
  run_interruptibly(
      progress, [&](const WorkControl& control) { result = work(control); }, [&] { return result && mark(*result); });
  return std::move(*result);
}

/// The same for work whose partial results are of no use: Ctrl-C always raises.
template <class Work>
auto interruptible(const py::object& progress, const Work& work) {
  return interruptible(progress, work, [](const auto&) { return false; });
}

/// Calls work(first, last) on blocks of [0, count) of at most `block` items each, on `threads` threads and without the
/// GIL. For items so short that a thread for a single one would cost more than the item. Signals are checked between
/// slices of about 30 ms; more than one thread is used only for work worth it.
void in_slices(long count, long block, int threads, const std::function<void(long, long)>& work);

}  // namespace ninedof::python
