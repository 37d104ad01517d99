#pragma once

#include <optional>

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// What keeps the gaps of pins open in a slicer whose own settings would close them, mm.
struct GapSettings {
  double closing_radius_mm = 0;  ///< of slices: gaps narrower than twice that are closed
  double elephant_foot_mm =
      0;                    ///< compensation: by which first layers are narrower, as they spread on the bed
  double expansion_mm = 0;  ///< of all contours in the plane
};

/// The radius is PrusaSlicer's own where that leaves the least clearance of a pin open. None of a sheet without pins.
std::optional<GapSettings> gap_settings(const PrintSheet& sheet);

}  // namespace kinetix::app
