#pragma once

#include <string>
#include <vector>

#include "app/sweep/plan/sweep_base.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {

/// Numbers that a file of the base's kind may hold even where this one leaves them out.
std::vector<std::string> optional_keys(const SweepBase& base);

/// "the base has no number at `design.tetha_deg`; the nearest is `design.theta_deg`"
std::string no_such_path(const SweepBase& base, const targets::DocumentEditor& editor,
                         const targets::DocumentPath& path);

}  // namespace kinetix::app
