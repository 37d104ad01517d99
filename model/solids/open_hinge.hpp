#pragma once

#include "model/matter/process.hpp"

namespace kinetix::model {

/// A hinge that a design does not describe, as a process makes it: a rod as thin and with as little clearance as it prints;
/// a block of its rubber, as thick as the wall; or a film of one line's thickness, of its hard material where walls and films
/// are one, else a strip of polypropylene. All as high as the wall; what spans a gap has none yet (open_gap_mm).
MadeHinge open_hinge(HingeKind kind, const Process& process, const CellSize& size);

/// Gap of a block or film that bears its turn and stretch, and at which neither the corners of its wall nor its own meet, up
/// to whole tenths of a mm. mm
/// @param offset_mm of the axis from the middle of the wall   @param turn largest, rad
/// @param stretch_mm by which its halves come apart, or run into each other
double open_gap_mm(const MadeHinge& hinge, double wall_mm, double offset_mm, double turn,
                   double stretch_mm = 0);

}  // namespace kinetix::model
