#pragma once

#include "app/console/console.hpp"
#include "app/files/design_file.hpp"
#include "model/base/progress.hpp"

namespace kinetix::app {

/// Options of `kinetix-opt export`, as on its command line.
struct PrintRequest {
  std::string source;                ///< a design, or the folder of a result
  std::vector<std::string> formats;  ///< by name; "all": every one
  std::string process;               ///< by name; empty: the design's, else polyjet
  std::string hinge;            ///< pin, block or film for open hinges; empty: the process's first that fits
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
  std::string card = "null";  ///< folding card as JSON (card_json); null for a coupon and imported bodies
  std::string report = {};    ///< path of the result's report, which now has the slicer's time; empty: none
};

/// Exports a design that is in memory. @param folder for the files
Exported export_design(const Design& design, const PrintRequest& request, const std::string& folder,
                       const Progress& progress = {});

/// Returns the help text of --format.
std::string format_help();

}  // namespace kinetix::app
