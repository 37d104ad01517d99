#pragma once

#include "app/print/format/print_format.hpp"
#include "app/print/sheet/path_clearance.hpp"
#include "app/run/run_options.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {

/// Error for a design that cannot be printed as it is. The program ends with exit code 3.
class NotPrintable : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// Error for the lock of a design that fits without it.
class LockDoesNotFit : public NotPrintable {
 public:
  using NotPrintable::NotPrintable;
};

/// A sheet that can be printed and folds.
struct PreparedPrint {
  PrintJob job;
  PathClearance clearance;
};

/// Prepares a print by a choice. Pins that the design leaves open are as high as the clearance along the path allows.
/// @throws NotPrintable for a sheet that the process cannot print, or whose hinges overlap a junction. Also for solids
/// that come too near along the path. The error names a cell edge that fits.
/// @throws InvalidInput for a bed that does not hold each body
PreparedPrint prepared(const Design& design, const model::Process& process, const PrintChoice& choice,
                       bool folded);

/// Prepares a print with the first kind of hinge that fits, of those that the process names (model::Process::hinges). A
/// warning gives the reason against each kind before it.
/// @param choice its kind does not count
/// @throws NotPrintable with the needs of the last kind.
/// @throws InvalidInput for a bed that does not hold each body
PreparedPrint prepare_fitting_print(const Design& design, const model::Process& process, PrintChoice choice,
                                    bool folded);

/// Describes the effect of other cells on size: "the sheet and what it folds to are 3.11 times as large". Empty for a
/// change within rounding.
std::optional<std::string> describe_resizing(double from_mm, double to_mm);

/// Returns the answer of `export` without options to a design, with its hinges: those that the design describes, and
/// the first kind that fits for the others.
PrintAnswer answer_of_export(const Design& design);

/// Finds the smallest cells, at least as large as the design's, with which `export` would write the design, mm. Walls
/// are as thick and high as the design's, or as the process needs. Empty if there are none up to 100 times as large.
std::optional<model::CellSize> find_printable_size(const Design& design);

}  // namespace kinetix::app
