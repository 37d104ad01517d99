#pragma once

#include <omp.h>

#include <cstdint>
#include <exception>
#include <limits>

#include "model/linkage/state.hpp"

namespace kinetix::python {

/// Calls fold(k, state) for every k below count, on as many threads; each hands its own state on from call to call, so that
/// memory is taken once. Which thread makes which fold changes no result. The exception of the least k is thrown again.
/// @param threads 0: all cores
template <class Fold>
void many_folds(std::int64_t count, int threads, Fold fold) {
  std::exception_ptr thrown;
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
#pragma omp parallel num_threads(threads > 0 ? threads : omp_get_max_threads())
  {
    model::State state;
#pragma omp for schedule(static)
    for (std::int64_t k = 0; k < count; ++k) {
      try {
        fold(k, state);
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

}  // namespace kinetix::python
