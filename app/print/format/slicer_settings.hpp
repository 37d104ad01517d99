#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinetix::app {

struct PrintJob;
struct PrintSheet;

/// Slicers that read settings of objects from a 3MF file. Each ignores the settings of the others.
enum class Slicer { prusa, orca, bambu, cura };

/// All slicers, in the order of the help.
inline constexpr Slicer all_slicers[] = {Slicer::prusa, Slicer::orca, Slicer::bambu, Slicer::cura};

/// Returns the name on the command line: "prusa".
std::string_view option_name(Slicer slicer);
/// Returns the name of the program: "PrusaSlicer".
std::string_view program_name(Slicer slicer);

/// Returns the slicers for which a 3MF file is written: the requested one, else all that slice for the process.
std::vector<Slicer> slicers_for(const PrintJob& job);

/// Checks whether the slicer slices for the process of a sheet. All slice for FDM, PrusaSlicer also for SLA.
bool can_slice(Slicer slicer, const PrintSheet& sheet);

/// Checks whether hard and soft parts are separate objects in the 3MF file. PrusaSlicer wants one object with ranges of
/// triangles. It drops separate objects to the bed one by one. The others do not know ranges.
bool has_separate_materials(const PrintJob& job);

/// Returns the least clearance of all pins, mm; empty without pins.
std::optional<double> least_clearance_mm(const PrintSheet& sheet);

/// Slicer settings that keep the gaps of pins open, mm. A slicer's own settings could close them.
struct GapSettings {
  double closing_radius_mm = 0;  ///< of slices: gaps narrower than twice this are closed
  double elephant_foot_mm =
      0;                    ///< compensation: first layers are narrower by this, as they spread on the bed
  double expansion_mm = 0;  ///< of all contours in the plane
};

/// Returns the settings of a sheet; empty without pins. The radius is PrusaSlicer's own if that leaves the least
/// clearance of a pin open.
std::optional<GapSettings> gap_settings(const PrintSheet& sheet);

/// Checks whether the elephant foot compensation is a setting of the printer, which no 3MF file brings: in SLA.
bool is_foot_of_printer(const PrintSheet& sheet);

/// Setting of an object in a 3MF file.
struct SlicerSetting {
  std::string key, value;  ///< as the slicer spells them
};
using SlicerSettings = std::vector<SlicerSetting>;

/// Returns the settings of the job's objects for a slicer (print.md section 4). Supports are off if none are
/// planned for FDM.
/// @param shared for a file that several slicers read: only keys that Orca and Bambu have in common
SlicerSettings object_settings(Slicer slicer, const PrintJob& job, bool shared = false);

}  // namespace kinetix::app
