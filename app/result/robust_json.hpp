#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/run.hpp"

namespace kinetix::app {

/// The section `robust` of formats.md. @pre run.robust
nlohmann::ordered_json robust_json(const Run& run);
/// Lines of the summary; none without a robust search.
std::vector<SummaryLine> robust_lines(const Run& run);

}  // namespace kinetix::app
