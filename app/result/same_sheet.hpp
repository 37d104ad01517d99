#pragma once

#include <nlohmann/json.hpp>

#include "app/files/design_file.hpp"

namespace kinetix::app {

/// What results say of a design's sheet: their section `structure`.
nlohmann::ordered_json sheet_json(const Design& design);

/// Whether a result is of this sheet: cells, walls, bodies and hinges differ by less than `rounding`, relative, or in mm and rad.
bool is_of_sheet(const nlohmann::ordered_json& result, const Design& design, double rounding);

}  // namespace kinetix::app
