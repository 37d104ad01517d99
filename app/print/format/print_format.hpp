#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "app/print/sheet/print_sheet.hpp"
#include "app/run/goal_outcome.hpp"

namespace kinetix::app {

/// Sheet to write, in one of its states.
struct PrintJob {
  PrintSheet sheet;
  bool folded = false;  ///< formats that show a motion ignore it and show all states

  std::optional<model::State> turned = {};  ///< the same state as lay() puts it on the bed
  std::string_view lie = "flat";            ///< orientation on the bed, a name of lies()

  const model::State& state() const { return turned ? *turned : unturned(); }
  /// Returns the state in the sheet's own place, however it lies on the bed.
  const model::State& unturned() const { return folded ? sheet.path.back() : sheet.path.front(); }
};

/// Kind of file that an export writes.
struct PrintFormat {
  std::string_view name;     ///< on the command line
  std::string_view meaning;  ///< for the help
  /// Writes the files. The same job always gives the same bytes.
  std::vector<NamedContent> (*write)(const PrintJob& job);
  /// Loads a library that only this format needs; null for most. It is called before a folder exists. If memory runs
  /// out, the loader ends the program, and nothing can clean up.
  void (*load)() = nullptr;
  bool is_always_flat = false;  ///< shows the flat sheet in every state of the job
  bool lies_on_bed = false;     ///< lies as the job is laid; other formats keep the sheet's own place
  bool turns_alone = false;     ///< its hinges only turn, and its sheet moves by itself
};

/// All formats, in the order of the help.
const std::vector<const PrintFormat*>& print_formats();

/// Finds a format. @throws InvalidInput for an unknown name, with the nearest one
const PrintFormat& print_format(std::string_view name);

constexpr double metres_per_mm = 1e-3;  // m/mm: glTF and MuJoCo count in metres
constexpr double mm3_per_cm3 = 1e3;     // mm^3/cm^3: material is sold by cm^3, and slicers report cm^3

/// all.stl, hard.stl and, for elastomer and living hinges, soft.stl: binary, mm, in common coordinates.
extern const PrintFormat stl_format;
/// NAME.3mf: one object. Both materials are triangle ranges with an extruder each (PrusaSlicer), and on each triangle
/// (by the book).
extern const PrintFormat threemf_format;
/// NAME.step: a solid per body, rod and soft part, with true cylinders and names.
extern const PrintFormat step_format;
/// NAME.svg, NAME.pdf: the flat sheet from above, 1:1 in mm, its hinges numbered.
extern const PrintFormat svg_format;
/// NAME.dxf: the flat sheet from above, 1:1 in mm, its hinges numbered. R12.
extern const PrintFormat dxf_format;
/// NAME.xml: MuJoCo scene, with an actuator that folds it.
extern const PrintFormat mjcf_format;
/// NAME.glb: glTF, in metres, y up, with the motion from flat to the fold as an animation.
extern const PrintFormat glb_format;
/// NAME.scad: modules of OpenSCAD for bodies and soft parts, in any state from flat to the fold.
extern const PrintFormat scad_format;

}  // namespace kinetix::app
