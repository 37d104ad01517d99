#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// The section `as_made` of result.json. @pre run.printed
nlohmann::ordered_json as_made_json(const Run& run);

/// Why prints do not hold, a sentence each; none where they do. @pre run.printed
std::vector<std::string> as_made_reasons(const Run& run);

/// What prints come to, in words, and what counts most. None where that is not known.
std::vector<SummaryLine> as_made_lines(const Run& run);

}  // namespace kinetix::app
