#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/print/path_clearance.hpp"
#include "app/print/print_format.hpp"

namespace kinetix::app {

/// print.json: what was written, of schema kinetix-print/1.
nlohmann::ordered_json print_json(const PrintJob& job, const PathClearance& clearance);

/// print.txt: how to print it, in words.
std::string print_text(const PrintJob& job, const PathClearance& clearance);

/// What one should know before printing: undersized gaps, strains, overhangs.
std::vector<std::string> print_warnings(const PrintJob& job, const PathClearance& clearance);

}  // namespace kinetix::app
