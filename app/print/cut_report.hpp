#pragma once

#include <nlohmann/json.hpp>

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Labels and texts of print.txt.
using CutLines = std::vector<std::pair<const char*, std::string>>;

/// Describes the sheet to cut, the cuts and the strain of the bridges. @pre the process cuts sheets
CutLines describe_cut(const PrintSheet& sheet);

/// Returns the section `cut` of print.json; null for a process that prints.
nlohmann::ordered_json cut_json(const PrintSheet& sheet);

}  // namespace kinetix::app
