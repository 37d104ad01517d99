#pragma once

#include <string>
#include <vector>

#include "app/console/console.hpp"
#include "app/files/design_file.hpp"
#include "model/base/progress.hpp"

namespace kinetix::app {

/// What `kinetix-opt export` is asked for, as its command line has it.
struct PrintRequest {
  std::string source;                ///< a design, or the folder of a result
  std::vector<std::string> formats;  ///< by name; "all": every one
  std::string process;               ///< by name; empty: the design's, else polyjet
  std::string
      hinge;  ///< pin, block or film where the design does not say; empty: pins where they fit, else blocks
  double clearance_mm = 0;  ///< of pins, the least of this printer, mm; 0: the process's
  double cell_mm = 0;       ///< cell edge instead of the design's, mm; 0: the design's
  std::vector<double>
      bed_mm;  ///< x and y of the printer's bed: a sheet that it does not hold is cut into tiles; empty: it is not
  bool loose_rods = false;  ///< rods of pins as parts of their own
  bool caps = false;        ///< knuckles of pins as round caps that all look alike, wherever their axes are
  bool folded = false;      ///< the state of the design instead of flat
  std::string orient = "flat";  ///< way to lie on the bed, of lies(), or "best": that with the least overhang
  bool slice = false;           ///< asks a slicer for time and material
  bool coupon = false;          ///< a test piece for hinges instead of the design
};

/// `kinetix-opt export DESIGN.yaml|DIR --format NAME`: files for slicers, CAD and simulators, all of them or none.
/// @return the exit code. @throws InvalidInput for what cannot be made, or not by the process
int export_command(const CommandOptions& options, const PrintRequest& request);

/// What an export has written.
struct Exported {
  std::string folder;
  std::vector<std::string> files;  ///< names in the folder
  std::string json, text;          ///< print.json and print.txt
  std::string report = {};         ///< of the design's result, which now has the slicer's time; empty: none
};

/// The same of a design in memory. @param folder for the files
Exported export_design(const Design& design, const PrintRequest& request, const std::string& folder,
                       const Progress& progress = {});

/// What the help says of --format.
std::string format_help();

}  // namespace kinetix::app
