#pragma once

#include <nlohmann/json_fwd.hpp>

#include "optim/solvers/multi_start.hpp"

namespace kinetix::app {

/// The `optimiser` of a search from many starts. @param chosen index of the run that the design comes from
nlohmann::ordered_json search_json(const optim::MultiStartResult& search, int chosen,
                                   optim::SolverName solver);

}  // namespace kinetix::app
