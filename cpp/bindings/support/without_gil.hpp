#pragma once
/// Work without the GIL that survives the end of the interpreter. A daemon thread that asks a finalizing interpreter
/// for the GIL is killed by pthread_exit, through frames of C++ that cannot be unwound: the process would abort. Here
/// such a thread stops its work and sleeps until the process is gone.

#include <pybind11/pybind11.h>
#ifdef __GLIBCXX__
#include <cxxabi.h>
#endif

#include <thread>

namespace ninedof::python {

/// Stops the work of the calls of this thread and never returns. To be called without the GIL.
[[noreturn]] void sleep_until_the_end();

/// A call of the core under way on this thread, made with the GIL held. `worker`, if there is one, is stopped and
/// joined where the thread has to sleep.
class CoreCall {
 public:
  explicit CoreCall(std::jthread* worker = nullptr);
  ~CoreCall();
  CoreCall(const CoreCall&) = delete;
  CoreCall& operator=(const CoreCall&) = delete;

  /// In a process forked from this call: its worker is in the parent alone, so that no result will come.
  bool left_by_worker() const { return left_by_worker_; }

 private:
  friend void sleep_until_the_end();
  friend void forget_other_threads();
  std::jthread* worker_;
  CoreCall* outer_;
  bool left_by_worker_ = false;
};

/// In the child of a fork, where of all threads only the forking one is left: its calls, if it is in any, go on.
void forget_other_threads();

/// While it lives this thread has no GIL. Where the interpreter ends meanwhile, the destructor never returns.
class WithoutGil {
 public:
  WithoutGil() : state_(PyEval_SaveThread()) {}
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  PyThreadState* state_;
};

/// Whether the interpreter is about to end and this thread has to sleep. For threads without the GIL, too.
bool interpreter_ends();

/// Calls Python from a call of the core: where the interpreter ends in it, the thread sleeps likewise.
template <class Call>
void call_python(const Call& call) {
#ifdef __GLIBCXX__
  try {
    call();
  } catch (const abi::__forced_unwind&) {
    sleep_until_the_end();
  }
#else
  call();
#endif
}

/// Has Python call off all work of the core before it finalizes.
void watch_interpreter_exit();

}  // namespace ninedof::python
