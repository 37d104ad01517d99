#pragma once

#include <optional>
#include <string>
#include <variant>

#include "app/display_file.hpp"
#include "app/fold_file.hpp"
#include "app/helmet_file.hpp"
#include "app/physics_section.hpp"
#include "app/solver_section.hpp"
#include "model/structure.hpp"
#include "targets/curve.hpp"

namespace kinetix {

/// A target.yaml of kind curve, as asked for or by default. Angles in radians, lengths in mm.
///
/// `kinetix: 1` and a `target` are enough. Left out, the structure is a strip [40, 1] whose cells give it the
/// curve's length at theta = 30 deg: cell_mm = length / (columns cos 30 deg); where cell_mm alone is given,
/// the number of columns follows from it in the same way. Walls follow default_size
/// (app/structure_section.hpp).
struct TargetFile {
  std::string name;  ///< default: the file's name without its ending
  Curve curve;       ///< target.points

  int columns = 40;    ///< structure.cells, >= 2
  int rows = 1;        ///< >= 1
  CellSize size = {};  ///< structure.cell_mm, structure.wall_mm

  AngleRange beta = {-60 * radians_per_degree, 60 * radians_per_degree};  ///< within +-89 deg
  Per per = Per::column;                                                  ///< column or all
  Symmetry symmetry = Symmetry::none;  ///< rotate_4 only where columns == rows
  AngleRange theta = {2 * radians_per_degree, 44 * radians_per_degree};  ///< within (0, 45) deg

  double shape_tolerance = 0.01;   ///< of shape_rms, over the curve's bounding-box diagonal, (0, 1]
  double verify_tolerance = 0.02;  ///< of verify_rms, cell edges, (0, 1]

  SolverSection solver = {};
  PhysicsSection physics = {};
};

/// A target of one of the kinds there are.
using Target = std::variant<TargetFile, DisplayFile, FoldFile, HelmetFile>;

/// @throws InvalidInput for whatever contracts.md does not allow, and for kinds that are not supported
Target read_target(const std::string& file);
/// The same of a document in memory.
Target read_target(const Node& root);
/// @throws InvalidInput likewise, and for kinds other than curve
TargetFile read_curve_target(const std::string& file);
/// The target's own name.
std::string name_of(const Target& target);

}  // namespace kinetix
