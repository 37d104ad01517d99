#pragma once

#include "app/files/design_file.hpp"
#include "app/print/sheet/print_path.hpp"
#include "app/run/run_options.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/material/process.hpp"
#include "model/solids/body_solid.hpp"

namespace kinetix::app {

/// Sheet to be printed: its flat solids, and how it folds. Lengths in mm, angles in rad.
struct PrintSheet {
  std::string name;
  model::Linkage linkage;
  model::Process process;
  std::vector<model::HingePrint> hinges;  ///< by index of the wall
  std::vector<model::BodySolid> bodies;   ///< relative to their rest positions, mm
  std::vector<model::Polyhedron> meshes;  ///< of the bodies, relative to their rest positions, mm
  std::vector<model::Polyhedron>
      soft;  ///< soft parts by hinge, from the lower body's rest position, mm; empty for a pin
  std::vector<model::Polyhedron>
      rods;                 ///< loose rods by hinge, from the lower body's rest position, mm; others: empty
  model::Posts posts = {};  ///< of the lock, by body
  std::optional<Lock> lock = {};  ///< that keeps it folded
  model::Polyhedron clip =
      {};            ///< part that is printed for the lock, from the bed up, mm; empty without a clip
  Tiles tiles = {};  ///< parts that are printed together
  std::vector<model::State> path;  ///< from flat to the fold (PrintPath); only flat if no motion is known
  std::vector<double> thetas;      ///< of the path, rad
  std::function<model::State(double)> motion = {};  ///< at a theta, rad; empty if it is not exact
  std::vector<model::TurnLaw> turns = {};           ///< of each hinge along that motion
  std::vector<int> jumps = {};                      ///< PrintPath::jumps
  bool is_path_exact = true;                        ///< else the equilibrium under the design's drive
  std::string no_path_reason = {};                  ///< reason if only the flat state is known
  std::vector<std::string> marks = {};  ///< engraved at each hinge of a cut sheet; empty: the hinge's number
  std::shared_ptr<const targets::CutSheet> cuts = {};  ///< that leave the sheet; null for all other sheets
  std::vector<model::HingeStiffness> imported_k = {};  ///< of hinges between imported parts, from the design
  std::vector<std::string> warnings = {};              ///< for the user

  bool has_soft() const;
  /// Checks whether parts are as imported: nothing makes or cuts them.
  bool is_imported() const { return !imported_k.empty(); }
  /// Checks whether knuckles are caps about the middle of their walls.
  bool has_caps() const;
  /// Checks whether living hinges are thin walls of the same print, as in FDM and SLS, which print walls that thin.
  bool is_one_material() const;
  int loose_rods() const;
  /// Returns a body with the loose rods that it carries as the lower body of a hinge, relative to its rest position.
  model::Polyhedron with_rods(int body) const;
  /// Returns the kind of most hinges; a pin for a sheet without hinges.
  model::HingeKind kind() const;
  /// Returns the first hinge of that kind. @pre there is a hinge
  int most_frequent_hinge() const;
};

/// Choices for hinges that the design does not describe, and for the size of the sheet.
struct PrintChoice {
  model::HingeKind kind = model::HingeKind::pin;
  double height_share = 1;  ///< pin's height over the wall's, (0, 1]: lower pins leave room if walls lean
  double clearance_mm = 0;  ///< least clearance per side of a pin, mm; 0: the process's
  bool alike = true;        ///< soft hinges are all as long as the longest; else each as long as it needs
  bool loose_rods = false;  ///< rods of pins are separate parts; else only between two tiles
  bool caps = false;  ///< knuckles are round caps about the middle of walls, sized for the largest offset
  std::optional<Eigen::Vector2d> bed_mm = {};  ///< printer's bed: a sheet that does not fit is cut into tiles
  double edge_mm = 0;  ///< cell edge, mm; 0: the design's. Walls only grow to what the process needs
};

/// Returns the bed of the user's printer, mm; empty if it is not given.
std::optional<Eigen::Vector2d> requested_bed(const model::Process& process);

/// Returns the size of cells with the chosen edge. Walls have at least the thickness, and with pins the height, that
/// the process needs. Walls that are cut from a sheet are as high as it is thick.
model::CellSize resized(const model::CellSize& size, const PrintChoice& choice,
                        const model::Process& process);

/// Makes the sheet of a design. Hinges that the design leaves open are pins with the least rod and clearance of the
/// process, or elastomer or living hinges as long as the fold needs.
/// @param path of the design.
/// @throws BedTooSmall for a bed that does not hold each body, or the whole of a sheet that is cut in one piece.
/// @throws InvalidInput for what the process cannot print, hinges that overlap a junction, and a sheet without hinges
PrintSheet make_print_sheet(const Design& design, const PrintPath& path, const model::Process& process,
                            const PrintChoice& choice);

/// Makes bodies, meshes and soft parts of a sheet whose linkage and hinges are known. @throws InvalidInput as
/// make_print_sheet
void make_solids(PrintSheet& sheet);

/// Returns a mesh in the frame of a body at the place of that body, mm.
model::Polyhedron placed(model::Polyhedron mesh, const model::Pose& pose);
/// Returns a body's mesh in a state, with its loose rods. @param state an element of path, or the rest state
model::Polyhedron placed_body(const PrintSheet& sheet, const model::State& state, int body);
/// Returns a soft part's mesh in a state. Each end moves with its own wall.
model::Polyhedron placed_soft(const PrintSheet& sheet, const model::State& state, int hinge);

/// Makes the sheet of a design of imported bodies: its meshes as they are, at rest or turned by its drive, and the
/// motion.
/// @throws InvalidInput for a folded state that its drive does not reach
PrintSheet imported_sheet(const Design& design, const model::Process& process, bool folded);

}  // namespace kinetix::app
