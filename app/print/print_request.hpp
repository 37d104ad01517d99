#pragma once

#include <string>
#include <vector>

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

}  // namespace kinetix::app
