#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/print/format/print_format.hpp"

namespace kinetix::app {

/// What a print takes, as a slicer estimates it.
struct SliceEstimate {
  double seconds = 0;       ///< of printing, s, > 0: all prints one after the other
  double material_mm3 = 0;  ///< of filament or resin, mm^3, with skirts, > 0
  bool supports = false;    ///< whether time and material have them
  int prints = 1;  ///< one where both materials are printed together, else one of each; and one of loose rods
};

/// Of a slicer that was asked.
struct SlicerAnswer {
  std::optional<SliceEstimate> estimate;
  std::string why_none = {};  ///< in words, where there is no estimate
};

/// Asks PrusaSlicer, with settings of the process alone: layers of 0.2 mm and a nozzle of 0.4 mm for FDM, layers of
/// 0.05 mm for SLA, nothing that closes gaps, supports where hinges lean more than FDM prints without. The printer's own
/// profile will differ. No answer for processes that it does not slice, and where it is missing.
/// @param program its name, sought on PATH, or its file
SlicerAnswer ask_slicer(const PrintJob& job, const std::string& program = "prusa-slicer");

/// "1d 2h 3m 4s" in seconds, any of the four missing; NaN for anything else.
double seconds_of(std::string_view text);

}  // namespace kinetix::app
