#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/files/design_file.hpp"

namespace kinetix::app {

/// Adds what a slicer says of a print to the report that lies beside a design: `print`, for its first screen. A report of
/// another sheet, of an older program or none is left alone.
/// @param design_file path of design.yaml   @param print seconds, material_mm3, process, hinges
/// @return the report's path, or nothing   @throws InvalidInput where it cannot be written
std::string tell_report(const std::string& design_file, const Design& design,
                        const nlohmann::ordered_json& print);

}  // namespace kinetix::app
