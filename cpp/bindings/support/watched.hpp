#pragma once
/// Long runs of the core that report progress and that Ctrl-C can stop.

#include <pybind11/pybind11.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <type_traits>

namespace ninedof::python {

namespace py = pybind11;

/// (how much is done, how much there is, the best known figure)
using Report = std::function<void(long, long, double)>;

/// Calls work(stop, report) on a thread of its own and without the GIL, while this one, the caller's, listens to signals
/// and passes the reports on to `progress`, a Python callable or None. Ctrl-C stops the run, which then returns what it has:
/// interrupted(outcome) says whether it did. An exception of `progress` stops it and goes on to the caller.
template <class Work, class Interrupted>
auto watched(const py::object& progress, const Work& work, const Interrupted& interrupted) {
  struct {
    std::mutex guard;
    std::condition_variable changed;
    bool finished = false;
    long done = 0, total = 0;
    double figure = 0.0;
  } news;
  std::invoke_result_t<Work, std::stop_token, Report> outcome;
  std::exception_ptr failure;
  std::jthread worker([&](const std::stop_token& stop) {
    try {
      outcome = work(stop, [&](long done, long total, double figure) {
        const std::lock_guard lock(news.guard);
        news.done = done;
        news.total = total;
        news.figure = figure;
      });
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(news.guard);
    news.finished = true;
    news.changed.notify_one();
  });
  const auto finish = [&] {
    const py::gil_scoped_release nogil;
    worker.join();
  };
  long reported = 0;
  for (bool finished = false; !finished;) {
    long done = 0, total = 0;
    double figure = 0.0;
    {
      const py::gil_scoped_release nogil;
      std::unique_lock lock(news.guard);
      news.changed.wait_for(lock, std::chrono::milliseconds(50), [&] { return news.finished; });
      finished = news.finished;
      done = news.done;
      total = news.total;
      figure = news.figure;
    }
    try {
      if (!progress.is_none() && done > reported) progress(done, total, figure);
      reported = done;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (py::error_already_set& error) {
      worker.request_stop();
      finish();
      // A run that was complete already has nothing to say of the interruption: the caller hears of it all the same.
      if (!error.matches(PyExc_KeyboardInterrupt) || (!failure && !interrupted(outcome))) throw;
      break;
    }
  }
  if (worker.joinable()) finish();
  if (failure) std::rethrow_exception(failure);
  return outcome;
}

}  // namespace ninedof::python
