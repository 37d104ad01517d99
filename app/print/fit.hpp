#pragma once

#include <optional>
#include <string>

#include "app/print/format/print_format.hpp"
#include "app/print/sheet/path_clearance.hpp"
#include "app/run/run_options.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {

/// A design that cannot be printed as it is. The program ends with exit code 3.
class NotPrintable : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// A sheet that can be printed and folds.
struct PreparedPrint {
  PrintJob job;
  PathClearance clearance;
};

/// Pins that the design leaves open are as high as leaves room on the way.
/// @throws NotPrintable, naming the cell edge that would do, for a sheet that the process cannot print, whose hinges
/// overlap a junction, or whose solids come nearer to each other on the way to the fold than they may; InvalidInput for
/// a bed that does not hold each body
PreparedPrint prepared(const Design& design, const model::Process& process, const PrintChoice& choice,
                       bool folded);

/// With pins where they fit, else with blocks, and a warning that says why. @param choice whose kind does not count
/// @throws NotPrintable and InvalidInput likewise, with what blocks would need
PreparedPrint prepared_as_fits(const Design& design, const model::Process& process, PrintChoice choice,
                               bool folded);

/// What larger or smaller cells do to a sheet: "the sheet and what it folds to are 3.11 times as large"; nothing where they do not
/// change it by more than rounding.
std::optional<std::string> resized_words(double from_mm, double to_mm);

/// Returns the answer of `export` without options to a design: pins if they fit, else blocks, and the hinges that the design
/// describes. It has no larger cell edge to propose, which takes long to find.
PrintAnswer answer_of_export(const Design& design);

}  // namespace kinetix::app
