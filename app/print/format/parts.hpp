#pragma once

#include <optional>

#include "app/print/format/print_format.hpp"
#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Rounds points to floats, as files hold them. All formats, and the volumes and masses reported for them, then have
/// the same corners.
model::Polyhedron as_filed(model::Polyhedron solid);

/// Returns all bodies of a job as one list of triangles, each a separate closed surface; mm, at their places in the
/// sheet. Loose rods are left out: they would be printed with their forks.
model::Polyhedron hard_part(const PrintJob& job);
/// Returns all soft parts as one list of triangles, mm, at their places in the sheet; empty without any.
model::Polyhedron soft_part(const PrintJob& job);
/// Joins hard and soft parts in one list.
model::Polyhedron joined(model::Polyhedron hard, const model::Polyhedron& soft);

/// Parts that are printed on one bed: bodies without loose rods, and their soft parts. A soft part between two tiles
/// is printed with the lower body. mm, at their places in the flat sheet.
struct TileParts {
  model::Polyhedron hard, soft;
};
TileParts tile_parts(const PrintJob& job, int tile);

/// Returns all loose rods side by side, lying along x on the plane z = 0, mm; empty without any.
model::Polyhedron laid_out_rods(const PrintSheet& sheet);

/// Slicer settings that keep the gaps of pins open, mm. A slicer's own settings would close them.
struct GapSettings {
  double closing_radius_mm = 0;  ///< of slices: gaps narrower than twice this are closed
  double elephant_foot_mm =
      0;                    ///< compensation: first layers are narrower by this, as they spread on the bed
  double expansion_mm = 0;  ///< of all contours in the plane
};

/// Returns the settings of a sheet; empty without pins. The radius is PrusaSlicer's own if that leaves the least
/// clearance of a pin open.
std::optional<GapSettings> gap_settings(const PrintSheet& sheet);

}  // namespace kinetix::app
