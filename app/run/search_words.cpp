#include "app/run/search_words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinetix::app {

void follow(const RunOptions& run, double mm, optim::SolverOptions& search) {
  search.stop = run.stop;
  search.heard = [progress = run.progress, mm, most = search.max_evaluations](int evaluations, double least) {
    if (!std::isfinite(least)) return;
    progress("search", -1,
             fmt::format("step {} of at most {}, best {:.2g} mm off", evaluations, most, least * mm));
  };
}

}  // namespace kinetix::app
