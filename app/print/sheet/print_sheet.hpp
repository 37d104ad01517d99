#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/files/design_file.hpp"
#include "app/print/sheet/print_path.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/matter/process.hpp"
#include "model/solids/body_solid.hpp"

namespace kinetix::app {

/// A sheet as it is made: its solids, flat, and how it folds. Lengths in mm, angles in rad.
struct PrintSheet {
  std::string name;
  model::Linkage linkage;
  model::Process process;
  std::vector<model::HingePrint> hinges;  ///< by index of the wall
  std::vector<model::BodySolid> bodies;   ///< relative to their rest positions, mm
  std::vector<model::Polyhedron> meshes;  ///< of the bodies, likewise
  std::vector<model::Polyhedron>
      soft;  ///< blocks and films by hinge, relative to the lower body's rest position, mm; of a pin empty
  std::vector<model::Polyhedron>
      rods;          ///< of pins whose rod is a part of its own, by hinge, likewise; of all others empty
  Tiles tiles = {};  ///< what is printed together
  std::vector<model::State> path;  ///< from flat to the fold (PrintPath); flat alone where no motion is known
  std::vector<double> thetas;      ///< of the path, rad
  std::function<model::State(double)> motion = {};  ///< at a theta, rad; empty where it is not exact
  std::vector<model::TurnLaw> turns = {};           ///< of each hinge along that motion
  std::vector<int> jumps = {};                      ///< PrintPath::jumps
  bool is_path_exact = true;                        ///< else of the equilibrium under the design's drive
  std::string why_no_path = {};                     ///< where it is flat alone
  std::vector<model::HingeStiffness> imported_k =
      {};                                  ///< of hinges between imported parts, as the design says
  std::vector<std::string> warnings = {};  ///< what its user should know

  bool has_soft() const;
  /// Whether parts are as they came: nothing makes or cuts them.
  bool is_imported() const { return !imported_k.empty(); }
  /// Whether knuckles are caps about the middle of their walls.
  bool has_caps() const;
  /// Whether its films are thin walls of the same print: those of FDM and SLS, which can be as thin as a film.
  bool is_one_material() const;
  int loose_rods() const;
  /// A body with the loose rods of its hinges that it carries (as the lower one), relative to its rest position.
  model::Polyhedron with_rods(int body) const;
  /// That of most hinges' kind: of a sheet without hinges a pin.
  model::HingeKind kind() const;
  /// The first hinge of that kind. @pre there is a hinge
  int usual_hinge() const;
};

/// How hinges are made that the design does not describe, and how large the sheet is.
struct PrintChoice {
  model::HingeKind kind = model::HingeKind::pin;
  double height_share =
      1;  ///< of a pin's height over the wall's: lower ones leave room where walls lean, (0, 1]
  double clearance_mm = 0;  ///< least of a pin instead of the process's, mm; 0: the process's
  bool alike = true;  ///< blocks and films as long everywhere as the longest; else each as long as it needs
  bool loose_rods = false;  ///< rods of pins are parts of their own; else only where two tiles meet
  bool caps =
      false;  ///< knuckles are round caps about the middle of their walls, all as large as the largest offset asks
  std::optional<Eigen::Vector2d> bed_mm =
      {};  ///< of the printer: a sheet that it does not hold, not even turned, is cut into tiles
  double edge_mm =
      0;  ///< cell edge instead of the design's, mm; 0: the design's. Walls stay, but for what the process needs
};

/// Of cells with the edge that was chosen: walls as thick, and where pins are chosen as high, as the process needs.
model::CellSize resized(const model::CellSize& size, const PrintChoice& choice,
                        const model::Process& process);

/// Whether the design leaves the kind of some hinge open.
bool leaves_hinges_open(const Design& design);

/// Hinges that the design leaves open have a rod and clearance as small as the process prints them, or are blocks of
/// rubber or films as long as the fold needs.
/// @param path of the design
/// @throws BedTooSmall for a bed that does not hold each body; other InvalidInput for what the process cannot print,
/// hinges that overlap a junction, and a sheet without hinges
PrintSheet make_print_sheet(const Design& design, const PrintPath& path, const model::Process& process,
                            const PrintChoice& choice);

/// Bodies, meshes and blocks of a sheet whose linkage and hinges are known. @throws InvalidInput as above
void make_solids(PrintSheet& sheet);

/// A mesh of a body's frame where that body stands, mm.
model::Polyhedron placed(model::Polyhedron mesh, const model::Pose& pose);
/// A body's or a block's mesh in a state of the path. @param state an element of path, or the rest state
model::Polyhedron placed_body(const PrintSheet& sheet, const model::State& state, int body);
/// Each end of a block goes with its own wall.
model::Polyhedron placed_soft(const PrintSheet& sheet, const model::State& state, int hinge);

}  // namespace kinetix::app
