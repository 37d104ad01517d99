#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Hinges of one kind and material.
struct HingeSort {
  model::HingeKind kind = model::HingeKind::pin;
  std::string material;  ///< its name, empty where the user gave numbers; of pins empty
  std::vector<const model::HingePrint*> hinges;  ///< of the sheet, not empty
};

/// In the order in which a sheet's hinges first have them.
std::vector<HingeSort> hinge_sorts(const PrintSheet& sheet);

/// "films of pp: gap 2 to 2.5 mm, ...". @param sheet that it is of
std::string hinge_words(const HingeSort& sort, const PrintSheet& sheet);

/// Where files do not tell soft parts of several materials apart, or the process makes hinges of another material than
/// their design counts with; nothing of soft parts that are a print of their own, whose material is free.
std::vector<std::string> material_warnings(const PrintSheet& sheet);

/// What says that films printed in one with their walls are thinner than the line that the nozzle lays; nothing of strips, which
/// are rolled or laid flat.
std::optional<std::string> thin_film_warning(const PrintSheet& sheet);

}  // namespace kinetix::app
