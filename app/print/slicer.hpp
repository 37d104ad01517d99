#pragma once

#include "app/print/format/print_format.hpp"

namespace kinetix::app {

/// Time and material of a print, as a slicer estimates them.
struct SliceEstimate {
  double seconds = 0;           ///< of printing, s, > 0: all prints one after the other
  double material_mm3 = 0;      ///< of filament or resin, mm^3, with skirts, > 0
  bool supports = false;        ///< whether time and material include supports
  bool lacks_supports = false;  ///< whether supports are needed that they do not include: those of SLA
  int prints = 1;  ///< one if both materials are printed together, else one each; and one of loose rods
};

constexpr double slicing_limit_s = 60;  // s: as long as users wait; the slicer itself can be used for longer

/// Answer of a slicer.
struct SlicerAnswer {
  std::optional<SliceEstimate> estimate;
  std::string no_estimate_reason = {};  ///< in words, if there is no estimate
};

/// Asks PrusaSlicer, with settings of the process alone: layers of 0.2 mm and a nozzle of 0.4 mm for FDM, layers of
/// 0.05 mm for SLA. No setting closes gaps. Supports are on for FDM if plan_supports needs them. The printer's own
/// profile will differ. There is no estimate for processes that it does not slice, without PrusaSlicer, and beyond the
/// time limit.
/// @param program its name, found on PATH, or its file
/// @param limit_s for all prints together, s, > 0: then the slicer is ended
SlicerAnswer estimate_by_slicer(const PrintJob& job, const std::string& program = "prusa-slicer",
                                double limit_s = slicing_limit_s);

/// Reads a duration such as "1d 2h 3m 4s", any of the four missing. @return seconds; NaN for anything else
double seconds_of(std::string_view text);

/// Joins the names of the slicers that a 3MF file is for and that slice for its process; empty without any.
std::string slicer_names(const PrintJob& job);

/// Returns lines of print.txt on the slicers that the files are for: label and text.
std::vector<std::pair<const char*, std::string>> slicer_advice(const PrintJob& job);

/// Warns if the 3MF file does not separate hard and soft parts for all its slicers.
std::optional<std::string> separation_warning(const PrintJob& job);

}  // namespace kinetix::app
