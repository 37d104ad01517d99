#pragma once

#include "app/print/format/print_format.hpp"

namespace kinetix::app {

/// all.stl, hard.stl and, of blocks and films, soft.stl: binary, mm, in common coordinates.
extern const PrintFormat stl_format;
/// NAME.3mf: one object, both materials as triangle ranges with an extruder each (PrusaSlicer) and on each triangle (by the book).
extern const PrintFormat threemf_format;
/// NAME.step: a solid a body and block, with true cylinders and names.
extern const PrintFormat step_format;
/// NAME.svg, NAME.pdf: the flat sheet from above, 1:1 in mm, its hinges numbered.
extern const PrintFormat svg_format;
/// NAME.dxf: likewise, R12.
extern const PrintFormat dxf_format;
/// NAME.xml: a scene of MuJoCo, with an actuator that folds it.
extern const PrintFormat mjcf_format;
/// NAME.glb: glTF, in metres, y up, with the way from flat to the fold as an animation.
extern const PrintFormat glb_format;
/// NAME.scad: modules of OpenSCAD for bodies and soft parts, anywhere on the way from flat to the fold.
extern const PrintFormat scad_format;

}  // namespace kinetix::app
