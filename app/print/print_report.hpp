#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/files/design_file.hpp"
#include "app/print/format/print_format.hpp"
#include "app/print/sheet/path_clearance.hpp"
#include "app/print/slicer.hpp"

namespace kinetix::app {

/// print.json: what was written, of schema kinetix-print/1. @param slicer none: it was not asked
nlohmann::ordered_json print_json(const PrintJob& job, const PathClearance& clearance,
                                  const std::optional<SlicerAnswer>& slicer = {});

/// What the report of a result says of its print: process, hinges, seconds, material_mm3, prints.
nlohmann::ordered_json estimate_json(const PrintJob& job, const SliceEstimate& print);

/// print.txt: how to print it, in words.
std::string print_text(const PrintJob& job, const PathClearance& clearance,
                       const std::optional<SlicerAnswer>& slicer = {});

/// What one should know before printing: undersized gaps, strains, overhangs.
std::vector<std::string> print_warnings(const PrintJob& job);

/// Adds what a slicer says of a print to the report that lies beside a design: `print`, for its first screen. A report of
/// another sheet, of an older program or none is left alone.
/// @param design_file path of design.yaml   @param print seconds, material_mm3, process, hinges
/// @return the report's path, or nothing   @throws InvalidInput where it cannot be written
std::string tell_report(const std::string& design_file, const Design& design,
                        const nlohmann::ordered_json& print);

}  // namespace kinetix::app
