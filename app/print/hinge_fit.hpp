#pragma once

#include <optional>
#include <string>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Why `export` refuses a run's sheet with the hinges that its prints are judged with, one sentence: those of its file, and
/// blocks where it leaves them open. Tried with the same solids along the same way to the fold.
/// @return nothing where they fit, the way to the fold has no closed form, by which it is tried, or the file says how stiff
/// hinges are and not how they are made
std::optional<std::string> why_hinges_do_not_fit(const Run& run);

}  // namespace kinetix::app
