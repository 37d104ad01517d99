#pragma once

#include "app/print/format/slicer_settings.hpp"
#include "app/print/sheet/print_sheet.hpp"
#include "app/run/search_result.hpp"

namespace kinetix::app {

/// Sheet to write, in one of its states.
struct PrintJob {
  PrintSheet sheet;
  bool folded = false;  ///< formats that show a motion ignore it and show all states

  std::optional<model::State> turned = {};  ///< the same state as lay() puts it on the bed
  std::string_view lie = "flat";            ///< orientation on the bed, a name of lies()
  std::optional<Slicer> slicer = {};        ///< that the 3MF is for; empty: all that slice for the process
  std::optional<Folding> folding = {};      ///< by the printed hinges; empty: not known

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
/// (by the book). For the other slicers both materials are objects, and a third object joins them.
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

/// Rounds points to floats, as files hold them. All formats, and the volumes and masses reported for them, then have
/// the same corners.
model::Polyhedron rounded_for_file(model::Polyhedron solid);

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

/// Checks whether a hinge has a rod that is a separate part, and that the process can print.
bool is_printable_rod(const PrintSheet& sheet, int hinge);

/// Returns these rods side by side, lying along x on the plane z = 0, mm; empty without any.
model::Polyhedron laid_out_rods(const PrintSheet& sheet);

/// Largest overhang that FDM prints without support, degrees from upright (print.md section 3).
constexpr double steep_deg = 45;

/// Returns the largest angle of a hinge axis from upright in the flat sheet, degrees, [0, 90].
double steepest_deg(const PrintSheet& sheet);

/// Returns the area of a solid's faces that look down and lean more than `steep_deg` from upright, mm^2. Faces on the
/// bed do not count. @param turn rotation of the solid before it is put on the bed
double overhang_mm2(const model::Polyhedron& solid, const Eigen::Matrix3d& turn);

/// Orientation on the bed, with its overhang.
struct PrintOrientation {
  std::string_view name;  ///< on the command line
  Eigen::Matrix3d turn;   ///< rotation matrix from the place in the files
  double overhang_mm2 = 0;
};

/// Returns both flat orientations of the hard and soft parts in the job's own state: as in the files (flat), and
/// turned over about x (over). On an edge most bodies would begin in the air.
std::vector<PrintOrientation> lies(const PrintJob& job);
/// Returns the orientation with the least overhang; ties go to the first.
const PrintOrientation& best(const std::vector<PrintOrientation>& all);

/// Turns the solids that `stl`, `3mf` and `step` write.
void lay(PrintJob& job, const PrintOrientation& lie);

/// Supports that a job needs as it lies in its files. Areas are of faces that lean more than `steep_deg` over the bed.
struct SupportPlan {
  double overhang_mm2 = 0;     ///< of all parts
  double within_pins_mm2 = 0;  ///< between the knuckles of pins, where faces bridge a clearance
  bool is_needed = false;      ///< of the user: outside pins faces lean, and the process carries none itself
};

/// Plans supports. Supports between knuckles could not be removed. Faces there count as bridges if the pin's axis leans
/// at most `steep_deg` from upright.
SupportPlan plan_supports(const PrintJob& job);

/// Describes the supports for print.txt.
std::string describe_supports(const PrintJob& job);

}  // namespace kinetix::app
