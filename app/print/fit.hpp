#pragma once

#include <optional>
#include <string>

#include "app/print/format/print_format.hpp"
#include "app/print/sheet/path_clearance.hpp"

namespace kinetix::app {

/// A sheet that can be printed and folds.
struct PreparedPrint {
  PrintJob job;
  PathClearance clearance;
};

/// Pins that the design leaves open are as high as leaves room on the way.
/// @throws InvalidInput, naming the cell edge that would do, for a sheet that the process cannot print, whose hinges
/// overlap a junction, or whose solids come nearer to each other on the way to the fold than they may; without an edge for
/// a bed that does not hold each body
PreparedPrint prepared(const DesignFile& design, const model::Process& process, const PrintChoice& choice,
                       bool folded);

/// With pins where they fit, else with blocks, and a warning that says why. @param choice whose kind does not count
/// @throws InvalidInput likewise, with what blocks would need
PreparedPrint prepared_as_fits(const DesignFile& design, const model::Process& process, PrintChoice choice,
                               bool folded);

/// What larger or smaller cells do to a sheet: "the sheet and what it folds to are 3.11 times as large"; nothing where they do not
/// change it by more than rounding.
std::optional<std::string> resized_words(double from_mm, double to_mm);

/// Why `prepared` would refuse a sheet, without the cell edge that would do, which takes long to find; nothing where it would
/// not.
std::optional<std::string> why_unprepared(const DesignFile& design, const model::Process& process,
                                          const PrintChoice& choice);

}  // namespace kinetix::app
