#include "support/without_gil.hpp"

#include <atomic>
#include <chrono>
#include <utility>
#include <vector>

namespace ninedof::python {

namespace py = pybind11;

namespace {

using namespace std::chrono_literals;

constexpr auto patience = 5s;  // longer than any call of the core takes to stop

/// Plain atomics: a mutex could be held by a thread that a fork leaves behind.
struct {
  std::atomic<bool> ending{false};
  std::atomic<std::thread::id> ender{};  // the thread that ends the interpreter may go on calling the core
  std::atomic<int> running{0};           // calls of the core
  std::atomic<int> returning{0};         // threads that are about to ask for the GIL
} exit_watch;

thread_local CoreCall* innermost = nullptr;

void end_calls() {
  exit_watch.ender = std::this_thread::get_id();
  exit_watch.ending = true;
  PyThreadState* const state = PyEval_SaveThread();
  // A thread that asked before `ending` was set still gets the GIL; one that comes later does not ask.
  const auto until = std::chrono::steady_clock::now() + patience;
  while ((exit_watch.running > 0 || exit_watch.returning > 0) && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(1ms);
  PyEval_RestoreThread(state);
}

}  // namespace

void forget_other_threads() {
  // Never joined nor destroyed: what is left of these threads is a number.
  static auto& gone = *new std::vector<std::jthread>;
  int own = 0;
  for (CoreCall* call = innermost; call != nullptr; call = call->outer_, ++own) {
    if (call->worker_ == nullptr) continue;
    gone.push_back(std::move(*call->worker_));
    call->worker_ = nullptr;
    call->left_by_worker_ = true;
  }
  exit_watch.ending = false;
  exit_watch.running = own;
  exit_watch.returning = 0;
}

bool interpreter_ends() {
  return exit_watch.ending && exit_watch.ender.load() != std::this_thread::get_id();
}

void sleep_until_the_end() {
  for (const CoreCall* call = innermost; call != nullptr; call = call->outer_) {
    if (call->worker_ != nullptr && call->worker_->joinable()) {
      call->worker_->request_stop();
      call->worker_->join();
    }
    --exit_watch.running;
  }
  for (;;) std::this_thread::sleep_for(1h);
}

CoreCall::CoreCall(std::jthread* worker) : worker_(worker), outer_(innermost) {
  innermost = this;
  ++exit_watch.running;
  if (!interpreter_ends()) return;
  PyEval_SaveThread();
  sleep_until_the_end();
}

CoreCall::~CoreCall() {
  innermost = outer_;
  --exit_watch.running;
}

WithoutGil::~WithoutGil() {
  // Announced before the flag is read: `end_calls` sets the flag before it reads the count.
  ++exit_watch.returning;
  if (interpreter_ends()) {
    --exit_watch.returning;
    sleep_until_the_end();
  }
  call_python([this] { PyEval_RestoreThread(state_); });
  --exit_watch.returning;
}

void watch_interpreter_exit() {
  exit_watch.ending = false;  // where a program starts a second interpreter after the first
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_calls));
  const py::module_ os = py::module_::import("os");
  if (py::hasattr(os, "register_at_fork"))
    os.attr("register_at_fork")(py::arg("after_in_child") = py::cpp_function(&forget_other_threads));
}

}  // namespace ninedof::python
