#pragma once

#include "model/matter/process.hpp"

namespace kinetix::model {

/// Returns the hinge that a process assumes if the design does not describe it. A pin has the thinnest rod and the
/// smallest clearance of the process. An elastomer block is of the process's rubber, as thick as the wall. A living
/// hinge has the thickness of one line. It is of the process's film material, or a strip of polypropylene if the
/// process has none. All are as high as the wall. Hinges that span a gap have none yet (open_gap_mm).
MadeHinge open_hinge(HingeKind kind, const Process& process, const CellSize& size);

/// Returns the gap of a block or film that withstands its turn and stretch, mm, rounded up to whole tenths.
/// At this gap neither the corners of its wall nor those of the block meet.
/// @param offset_mm of the axis from the middle of the wall   @param turn largest, rad
/// @param stretch_mm by which its halves separate or approach
double open_gap_mm(const MadeHinge& hinge, double wall_mm, double offset_mm, double turn,
                   double stretch_mm = 0);

}  // namespace kinetix::model
