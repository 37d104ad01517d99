#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "app/print/sheet/print_sheet.hpp"
#include "app/run/goal_outcome.hpp"

namespace kinetix::app {

/// What is written: a sheet in one of its states.
struct PrintJob {
  PrintSheet sheet;
  bool folded = false;  ///< formats that show a motion show all of it

  std::optional<model::State> turned = {};  ///< the same state, laid on the bed another way (lay)
  std::string_view lie = "flat";            ///< which way, of lies()

  const model::State& state() const { return turned ? *turned : unturned(); }
  /// The state in the sheet's own place, whichever way it lies on the bed.
  const model::State& unturned() const { return folded ? sheet.path.back() : sheet.path.front(); }
};

/// A kind of file.
struct PrintFormat {
  std::string_view name;     ///< as the command line says it
  std::string_view meaning;  ///< for its help
  /// The same bytes for the same job.
  std::vector<NamedContent> (*write)(const PrintJob& job);
  /// Loads what the program loads for this format alone; nothing for most. Before a folder is there: where memory runs out, the
  /// loader ends the program and nobody can clean up.
  void (*load)() = nullptr;
  bool is_always_flat = false;  ///< shows the flat sheet in every state of the job
  bool lies_on_bed = false;     ///< lies as the job is laid; others have the sheet in its own place
  bool turns_alone = false;     ///< its hinges turn and do not stretch, and its sheet moves by itself
};

/// All formats, in the order of the help.
const std::vector<const PrintFormat*>& print_formats();

/// @throws InvalidInput for a name that none has, with the nearest one
const PrintFormat& print_format(std::string_view name);

constexpr double metres_per_mm = 1e-3;  // m/mm: glTF and MuJoCo count in metres
constexpr double mm3_per_cm3 = 1e3;     // mm^3/cm^3: people buy material by cm^3, slicers tell it so

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
