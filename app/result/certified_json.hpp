#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// The section `certified` of result.json. @param theta of the state shown, rad
nlohmann::ordered_json certified_json(const Certified& certified, const model::Sheet& sheet, double theta);

/// Lines of the summary, and of `check`. @param theta of the state shown, rad
std::vector<SummaryLine> certified_lines(const Certified& certified, const model::Sheet& sheet, double theta);

}  // namespace kinetix::app
