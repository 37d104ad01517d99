#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <exception>
#include <limits>

#include "model/base/parallel_runs.hpp"
#include "model/linkage/state.hpp"
#include "python/bindings/interruptible.hpp"

namespace kinetix::python {

/// Calls fold(k, state) for every k below count, on several threads. Each thread passes its state on from call to
/// call, so that memory is taken once. Which thread makes which fold changes no result. The exception of the least k
/// is thrown again.
/// @param threads at least 1.   @param stop leaves the rest out when requested.   @tparam State of a fold
template <class State, class Fold>
void many_folds(std::int64_t count, int threads, const std::stop_token& stop, Fold fold) {
  std::exception_ptr thrown;
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
#pragma omp parallel num_threads( \
    static_cast <int>(std::min <std::int64_t>(threads, std::max <std::int64_t>(count, 1))))
  {
    State state;
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

// Number of folded bodies from which several threads and a watch for Ctrl-C are worth their cost; fewer take some
// milliseconds.
inline constexpr std::int64_t min_work_for_threads = 100'000;

/// Calls fold(k, state) for every k below count, without the interpreter's lock. From min_work_for_threads bodies on, several
/// threads are used and Ctrl-C raises KeyboardInterrupt. They are never threads of the caller's thread, since a
/// process that it forks later could not use those.
/// @param bodies of a fold.   @param threads 0 = all cores.   @throws InvalidInput unless threads is 0 to 1024. @pre
/// the lock is held
template <class State = model::State, class Fold>
void many_folds_in_python(std::int64_t count, std::int64_t bodies, int threads, Fold fold) {
  const int used = model::threads_of(threads);
  if (count * bodies >= min_work_for_threads)
    return run_interruptibly(
        [&](const std::stop_source& stop) { many_folds<State>(count, used, stop.get_token(), fold); }, {},
        false);
  const pybind11::gil_scoped_release others_may_run;
  many_folds<State>(count, 1, {}, fold);
}

}  // namespace kinetix::python
