#pragma once

#include "app/goals/outline/outline_search.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {

/// Returns how far an outline is from the goal, relative to the tolerances of its file: at most 1 if it is met.
double outline_excess(const OutlineFile& file, const targets::OutlineError& error);

/// Returns changes of its file that may bring a panel nearer to its outline: trimmed cells, more cells, and then other
/// lattices, few cells first.
std::vector<targets::DocumentChanges> outline_remedies(const OutlineFile& file,
                                                       const optim::OutlineDesign& missed);

}  // namespace kinetix::app
