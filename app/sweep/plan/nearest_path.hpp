#pragma once

#include <string>
#include <vector>

#include "app/sweep/plan/sweep_base.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {

/// Lists the numbers that a file of the base's kind may hold, also those that this file leaves out.
std::vector<std::string> optional_keys(const SweepBase& base);

/// Returns a message such as "the base has no number at `design.tetha_deg`; the nearest is
/// `design.theta_deg`".
std::string no_such_path(const SweepBase& base, const targets::DocumentEditor& editor,
                         const targets::DocumentPath& path);

}  // namespace kinetix::app
