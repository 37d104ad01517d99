#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/print/format/print_format.hpp"

namespace kinetix::app {

/// Joins the names of the slicers that a 3MF file is for and that slice for its process; empty without any.
std::string slicer_names(const PrintJob& job);

/// Returns lines of print.txt on the slicers that the files are for: label and text.
std::vector<std::pair<const char*, std::string>> slicer_advice(const PrintJob& job);

/// Warns if the 3MF file does not separate hard and soft parts for all its slicers.
std::optional<std::string> separation_warning(const PrintJob& job);

}  // namespace kinetix::app
