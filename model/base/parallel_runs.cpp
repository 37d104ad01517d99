#include "model/base/parallel_runs.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

constexpr int max_threads = 1024;  // more exhaust the memory for stacks, and OpenMP then ends the program

// OpenMP orders what runs before, in and after a parallel region. The thread sanitizer cannot see that,
// because the OpenMP runtime is not instrumented. These counters repeat the ordering as C++ atomics, so that
// its reports are real.
std::atomic<int> entered{0}, left{0};

void before_region() { entered.fetch_add(1, std::memory_order_release); }
void enter_region() { entered.load(std::memory_order_acquire); }
void leave_region() { left.fetch_add(1, std::memory_order_release); }
void after_region() { left.load(std::memory_order_acquire); }

/// Runs the loop. Not instrumented itself, because of the variables that the compiler passes to the threads.
/// Everything that it calls is instrumented.
__attribute__((no_sanitize("thread"))) void fill(int count, int threads,
                                                 const std::function<void(int)>& run) {
  before_region();
#pragma omp parallel num_threads(threads)
  {
    enter_region();
#pragma omp for schedule(dynamic, 1) nowait
    for (int k = 0; k < count; ++k) run(k);
    leave_region();
  }
  after_region();
}

/// The exception of the run with the least index.
class Thrown {
 public:
  /// @pre an exception is being handled
  void keep(int k) {
    const std::lock_guard lock(mutex_);
    if (exception_ && first_ < k) return;
    exception_ = std::current_exception();
    first_ = k;
  }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr exception_;
  int first_ = 0;
};

}  // namespace

int threads_of(int requested) {
  require("threads", requested, requested >= 0 && requested <= max_threads, "0 (all cores) to 1024");
  return requested > 0 ? requested : omp_get_max_threads();
}

void run_in_parallel(int count, int threads, const std::function<void(int)>& run) {
  if (count < 1) return;
  Thrown thrown;
  fill(count, std::min(threads_of(threads), count), [&](int k) {
    try {
      run(k);
    } catch (...) {
      thrown.keep(k);
    }
  });
  thrown.rethrow();
}

}  // namespace kinetix::model
