#include "app/run/run_options.hpp"

#include <fmt/format.h>
#include <cmath>

namespace kinetix::app {

void follow(const RunOptions& run, double mm, optim::SolverOptions& search) {
  search.stop = run.stop;
  search.on_progress = [progress = run.progress, mm, most = search.max_evaluations](int evaluations,
                                                                                    double least) {
    if (!std::isfinite(least)) return;
    progress("search", -1,
             fmt::format("step {} of at most {}, best {:.2g} mm off", evaluations, most, least * mm));
  };
}

optim::MultiStartOptions followed(optim::MultiStartOptions search, const RunOptions& run,
                                  std::function<std::string(double least)> describe) {
  search.threads = run.threads;
  search.seed = run.seed;
  search.solver.stop = run.stop;
  search.ended = [progress = run.progress, starts = search.starts, describe = std::move(describe)](
                     int ended, double least) {
    progress("search", static_cast<double>(ended) / starts,
             fmt::format("start {} of {}, {}", ended, starts, describe(least)));
  };
  return search;
}

}  // namespace kinetix::app
