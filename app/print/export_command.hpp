#pragma once

#include "app/console/console.hpp"
#include "app/console/short_form.hpp"
#include "app/print/format/print_format.hpp"
#include "model/base/progress.hpp"

namespace kinetix::app {

/// Options of `kinetix-opt export`, as on its command line.
struct PrintRequest {
  std::string source;                ///< a design, or the folder of a result
  std::vector<std::string> formats;  ///< by name; "all": every one
  std::string process;               ///< by name; empty: the design's, else polyjet
  std::string hinge;  ///< pin, block, film or rod, for open hinges; empty: the process's first that fits
  double clearance_mm = 0;      ///< per side of pins, least of this printer, mm; 0: the process's
  double cell_mm = 0;           ///< cell edge instead of the design's, mm; 0: the design's
  std::vector<double> bed_mm;   ///< x and y of the printer's bed: larger sheets become tiles; empty: no limit
  std::string lock;             ///< clip, strap or none; empty: the design's
  bool loose_rods = false;      ///< rods of pins as separate parts
  bool caps = false;            ///< knuckles of pins as equal round caps, wherever their axes are
  bool folded = false;          ///< the state of the design instead of flat
  std::string orient = "flat";  ///< orientation on the bed: a name of lies(), or "best", the least overhang
  std::string slicer;           ///< by name, that the 3MF is for; empty: all that slice for the process
  bool slice = false;           ///< asks a slicer for time and material
  bool coupon = false;          ///< a test piece for hinges instead of the design
};

/// Runs `kinetix-opt export DESIGN.yaml|DIR --format NAME`: writes files for slicers, CAD and simulators, all of them
/// or none. @return the exit code. @throws InvalidInput for sheets that cannot be made, or not by the process
int export_command(const CommandOptions& options, const PrintRequest& request);

/// Files that an export has written.
struct Exported {
  std::string folder;
  std::vector<std::string> files;  ///< names in the folder
  std::string json, text;          ///< print.json and print.txt
  ShortForm form = {};             ///< for the console
  std::string card = "null";  ///< folding card as JSON (card_json); null for a coupon and imported bodies
  std::string report = {};    ///< path of the result's report, which now has the slicer's time; empty: none
};

/// Exports a design that is in memory. @param folder for the files
Exported export_design(const Design& design, const PrintRequest& request, const std::string& folder,
                       const Progress& progress = {});

/// Returns the help text of --format.
std::string format_help();

/// Returns the process to print by. The design's own limits also apply if its process is requested by name.
/// @param of_design the design's process
model::Process process_of(const PrintRequest& request, const model::Process& of_design);

/// Returns the requested kind of hinge; empty: the first that fits.
std::optional<model::HingeKind> kind_of(const PrintRequest& request);

/// Returns the requested kind of lock; empty: the design's.
std::optional<LockKind> lock_of(const PrintRequest& request);

/// Returns the slicer that the 3MF file is for; empty: all.
std::optional<Slicer> slicer_of(const PrintRequest& request);

/// Returns the requested formats. @throws InvalidInput for an unknown name, as all functions above
std::vector<const PrintFormat*> formats_of(const PrintRequest& request);

/// Rejects a clearance that is larger than that of the design's own pins.
void check_clearance_override(const PrintRequest& request, const Design& design);

/// Checks whether options change the process, hinges or cells of a design.
bool changes_sheet(const PrintRequest& request, const Design& design);

/// Returns the design to print. Joints are left open again for another process, another kind of hinge, or other sizes of
/// hinges or cells. The motion of joints does not depend on their hinges.
Design reopened(Design design, const PrintRequest& request);

/// Rejects options that would change a coupon. Its bed and orientation may be chosen.
void reject_design_options(const PrintRequest& request);

/// Rejects options that make sheets: imported bodies are written as their parts are.
/// @param is_cut whether the bodies are cut from one sheet, which drawings show
void reject_sheet_options(const PrintRequest& request, bool is_cut);

/// Rejects the folded state of a sheet for which only the flat state is known.
void check_state(const PrintRequest& request, const PrintSheet& sheet);
/// Lays a job on the bed as requested.
void lay_as_requested(const PrintRequest& request, PrintJob& job);

/// Notes on a sheet: requested options that change nothing, and differences from its design, a sentence each.
/// @param design as the file has it   @param printed the same with the requested choices
std::vector<std::string> notes_on_sheet(const PrintRequest& request, const Design& design,
                                        const Design& printed, const PrintSheet& sheet);

/// Notes on files that ignore a requested option, a sentence each.
std::vector<std::string> notes_on_files(const PrintRequest& request,
                                        const std::vector<const PrintFormat*>& formats, const PrintJob& job);

}  // namespace kinetix::app
