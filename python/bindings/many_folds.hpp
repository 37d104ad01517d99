#pragma once

#include <omp.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <limits>
#include <stop_token>

#include "model/linkage/state.hpp"
#include "python/bindings/interruptible.hpp"

namespace kinetix::python {

// Fewer take less time than another thread takes to come.
inline constexpr std::int64_t folds_a_thread = 64;

/// Calls fold(k, state) for every k below count, on as many threads; each hands its own state on from call to call, so that
/// memory is taken once. Which thread makes which fold changes no result. The exception of the least k is thrown again.
/// @param threads 0: all cores   @param stop where it asks to, the rest is left out
template <class Fold>
void many_folds(std::int64_t count, int threads, const std::stop_token& stop, Fold fold) {
  std::exception_ptr thrown;
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  const std::int64_t allowed = threads > 0 ? threads : omp_get_max_threads();
#pragma omp parallel num_threads(static_cast <int>(std::min(allowed, 1 + count / folds_a_thread)))
  {
    model::State state;
#pragma omp for schedule(static)
    for (std::int64_t k = 0; k < count; ++k) {
      try {
        if (!stop.stop_requested()) fold(k, state);
      } catch (...) {
#pragma omp critical(kinetix_python_many_folds)
        if (k < first) {
          first = k;
          thrown = std::current_exception();
        }
      }
    }
  }
  if (thrown) std::rethrow_exception(thrown);
}

// Of bodies that are folded: more take some tenths of a second, in which somebody may press Ctrl-C; a thread that waits for that
// takes as long as a hundred folds.
inline constexpr std::int64_t worth_interrupting = 1'000'000;

/// The same without the interpreter's lock; where there is much to do, Ctrl-C raises KeyboardInterrupt.
/// @param bodies of a fold. @pre the lock is held
template <class Fold>
void many_folds_in_python(std::int64_t count, std::int64_t bodies, int threads, Fold fold) {
  const auto work = [&](const std::stop_source& stop) { many_folds(count, threads, stop.get_token(), fold); };
  if (count * bodies >= worth_interrupting) return run_interruptibly(work, {}, false);
  const pybind11::gil_scoped_release others_may_run;
  work({});
}

}  // namespace kinetix::python
