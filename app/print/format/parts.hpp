#pragma once

#include <optional>

#include "app/print/format/print_format.hpp"
#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// As files hold places, in floats: all formats, and the volumes and masses that are said of them, are of the same
/// corners.
model::Polyhedron as_filed(model::Polyhedron solid);

/// All bodies of a job as one list of triangles, each a closed surface of its own; mm, where they are in the sheet. Without
/// loose rods, which would be printed with their forks.
model::Polyhedron hard_part(const PrintJob& job);
/// All blocks and films likewise; empty where there are none.
model::Polyhedron soft_part(const PrintJob& job);
/// Both in one list.
model::Polyhedron joined(model::Polyhedron hard, const model::Polyhedron& soft);

/// What is printed on one bed: bodies without loose rods, and their soft parts, those between two tiles with the lower
/// body's. Where they are in the flat sheet, mm.
struct TileParts {
  model::Polyhedron hard, soft;
};
TileParts tile_parts(const PrintJob& job, int tile);

/// All loose rods side by side, lying along x on the plane z = 0, mm; empty where there are none.
model::Polyhedron laid_out_rods(const PrintSheet& sheet);

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
