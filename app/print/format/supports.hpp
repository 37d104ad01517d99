#pragma once

#include "app/print/format/print_format.hpp"

namespace kinetix::app {

/// Supports that a job needs as it lies in its files. Areas are of faces that lean more than `steep_deg` over the bed.
struct SupportPlan {
  double overhang_mm2 = 0;     ///< of all parts
  double within_pins_mm2 = 0;  ///< between the knuckles of pins, where faces bridge a clearance
  bool is_needed = false;      ///< of the user: outside pins faces lean, and the process carries none itself
};

/// Plans supports. Supports between knuckles could not be removed. Faces there count as bridges if the pin's axis leans
/// at most `steep_deg` from upright.
SupportPlan plan_supports(const PrintJob& job);

/// Describes the supports for print.txt.
std::string describe_supports(const PrintJob& job);

}  // namespace kinetix::app
