#pragma once

#include "app/console/short_form.hpp"
#include "app/files/design_file.hpp"
#include "app/print/format/print_format.hpp"
#include "app/print/sheet/path_clearance.hpp"
#include "app/print/slicer.hpp"

namespace kinetix::app {

/// Returns print.json, of schema kinetix-print/1. @param slicer empty: not requested
nlohmann::ordered_json print_json(const PrintJob& job, const PathClearance& clearance,
                                  const std::optional<SlicerAnswer>& slicer = {});

/// Returns the estimate for the report of a result: process, hinges, seconds, material_mm3, prints.
nlohmann::ordered_json estimate_json(const PrintJob& job, const SliceEstimate& print);

/// Returns print.txt: how to print it, in words.
std::string print_text(const PrintJob& job, const PathClearance& clearance,
                       const std::optional<SlicerAnswer>& slicer = {});

/// Composes the output of an export, without its files: pieces, hinges, force, supports and warnings.
ShortForm export_form(const PrintJob& job, const PathClearance& clearance,
                      const std::optional<SlicerAnswer>& slicer = {});

/// Lists what to know before printing: undersized gaps, strains, overhangs.
std::vector<std::string> print_warnings(const PrintJob& job);

/// Adds a slicer's estimate to the report next to a design: `print`, for its first screen. A report of another sheet
/// or of an older program stays as it is.
/// @param design_file path of design.yaml.   @param print seconds, material_mm3, process, hinges.
/// @return the report's path, or an empty text.   @throws InvalidInput if it cannot be written
std::string add_to_report(const std::string& design_file, const Design& design,
                          const nlohmann::ordered_json& print);

/// Describes the rods that are separate parts: number and lengths, where they come from, and how they are pushed in.
/// No full stop at the end. @pre there are such rods
std::string describe_rods(const PrintSheet& sheet);

/// Returns the list `rods` of print.json: rods of one size and material each.
nlohmann::ordered_json rods_json(const PrintSheet& sheet);

/// Labels and texts of print.txt.
using CutLines = std::vector<std::pair<const char*, std::string>>;

/// Describes the sheet to cut, the cuts and the strain of the bridges. @pre the process cuts sheets
CutLines describe_cut(const PrintSheet& sheet);

/// Returns the section `cut` of print.json; null for a process that prints.
nlohmann::ordered_json cut_json(const PrintSheet& sheet);

}  // namespace kinetix::app
