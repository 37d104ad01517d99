#pragma once

#include <string>
#include <vector>

#include "app/sweep/sweep_base.hpp"
#include "targets/edit_document.hpp"

namespace kinetix {

/// Numbers that a file of the base's kind may hold even where this one leaves them out.
std::vector<std::string> optional_keys(const SweepBase& base);

/// "the base has no number at `design.tetha_deg`; the nearest is `design.theta_deg`"
std::string no_such_path(const SweepBase& base, const DocumentEditor& editor, const DocumentPath& path);

}  // namespace kinetix
