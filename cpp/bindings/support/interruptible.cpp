#include "support/interruptible.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "ninedof/math/parallel.hpp"

namespace ninedof::python {

void run_interruptibly(const py::object& progress, const std::function<void(const WorkControl&)>& work,
                       const std::function<bool()>& mark) {
  struct {
    std::mutex guard;
    std::condition_variable_any changed;
    bool finished = false;
    const std::function<void()>* call = nullptr;  // to be run on the calling thread
    long done = 0, total = 0;
    double value = 0.0;
  } shared;
  std::exception_ptr failure;
  std::jthread worker([&](const std::stop_token& stop) {
    try {
      WorkControl control;
      control.stop = stop;
      control.progress = [&](long done, long total, double value) {
        const std::lock_guard lock(shared.guard);
        shared.done = done;
        shared.total = total;
        shared.value = value;
      };
      control.on_calling_thread = [&](const std::function<void()>& call) {
        std::unique_lock lock(shared.guard);
        shared.call = &call;
        shared.changed.notify_all();
        shared.changed.wait(lock, stop, [&] { return shared.call == nullptr; });
      };
      work(control);
    } catch (const Stopped&) {  // no result: the exception that asked for the stop says why
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(shared.guard);
    shared.finished = true;
    shared.changed.notify_all();
  });
  const CoreCall call(&worker);
  const auto join = [&] {
    const WithoutGil nogil;
    worker.join();
  };
  long reported = 0;
  for (bool finished = false; !finished;) {
    long done = 0, total = 0;
    double value = 0.0;
    const std::function<void()>* asked = nullptr;
    {
      const WithoutGil nogil;
      std::unique_lock lock(shared.guard);
      shared.changed.wait_for(lock, std::chrono::milliseconds(20), [&] { return shared.finished || shared.call; });
      asked = shared.call;
      finished = shared.finished;
      done = shared.done;
      total = shared.total;
      value = shared.value;
    }
    try {
      if (!progress.is_none() && done > reported)
        call_python(
            [&] { progress(done, total, std::isnan(value) ? py::object(py::none()) : py::object(py::float_(value))); });
      reported = done;
      if (asked != nullptr) {
        call_python(*asked);
        const std::lock_guard lock(shared.guard);
        shared.call = nullptr;
        shared.changed.notify_all();
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (const py::error_already_set& error) {
      if (call.left_by_worker() && !finished) throw;
      worker.request_stop();
      if (worker.joinable()) join();
      const bool returned = failure || mark();
      if (!error.matches(PyExc_KeyboardInterrupt) || !returned) throw;
      break;
    }
    if (call.left_by_worker() && !finished)
      throw std::runtime_error("this process was forked while the call was under way: it goes on in the parent only");
  }
  if (worker.joinable()) join();
  if (failure) std::rethrow_exception(failure);
}

void in_slices(long count, long block, int threads, const std::function<void(long, long)>& work) {
  using Clock = std::chrono::steady_clock;
  constexpr double slice_seconds = 0.03, worth_a_thread = 0.5e-3;
  const long most = std::max(1L, count);
  long length = std::min(block, most);
  int workers = 1;
  const CoreCall call;
  for (long first = 0; first < count;) {
    const long last = std::min(count, first + length);
    const auto start = Clock::now();
    {
      const WithoutGil nogil;
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
