#pragma once

#include <nlohmann/json.hpp>

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Describes the rods that are separate parts: number and lengths, where they come from, and how they are pushed in.
/// No full stop at the end. @pre there are such rods
std::string describe_rods(const PrintSheet& sheet);

/// Returns the list `rods` of print.json: rods of one size and material each.
nlohmann::ordered_json rods_json(const PrintSheet& sheet);

}  // namespace kinetix::app
