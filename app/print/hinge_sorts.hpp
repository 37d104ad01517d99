#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Hinges of one kind and material.
struct HingeSort {
  model::HingeKind kind = model::HingeKind::pin;
  std::string material;                          ///< its name; empty for pins, and if the user gave numbers
  std::vector<const model::HingePrint*> hinges;  ///< of the sheet, not empty
};

/// Groups a sheet's hinges, in the order in which they first occur.
std::vector<HingeSort> hinge_sorts(const PrintSheet& sheet);

/// Describes the hinges of a sort: "films of pp: gap 2 to 2.5 mm, ...". @param sheet that has them
std::string hinge_words(const HingeSort& sort, const PrintSheet& sheet);

/// Warns of files that do not separate soft parts of several materials. Also warns of hinges that the process prints
/// of another material than the design assumes. Soft parts that are a separate print may be of any material.
std::vector<std::string> material_warnings(const PrintSheet& sheet);

/// Warns of living hinges that are thinner than the line that the nozzle lays, if they are printed in one with their
/// walls. Empty for separate strips, which are rolled or laid flat.
std::optional<std::string> thin_film_warning(const PrintSheet& sheet);

}  // namespace kinetix::app
