#pragma once

#include <string>

#include "app/physics_section.hpp"
#include "app/solver_section.hpp"
#include "optim/helmet_layout.hpp"
#include "targets/head.hpp"

namespace kinetix {

/// A target.yaml of kind helmet, as asked for or by default. `kinetix: 1` and a `target` with a mesh are
/// enough.
///
///     target: {kind: helmet, mesh: head.obj, units: mm, up: z, front: -y, crown: [x, y, z], ribs: 8,
///              spacing_mm: 40, coverage_mm: 90, clearance_mm: 5}       # ribs or spacing_mm
///     structure: {cell_mm: 6, wall_mm: {thickness: 0.6, height: 3.6}}
///     variables: {beta: {range_deg: [-60, 60]}, theta: {range_deg: [2, 40]}}
///     tolerance: {rms_mm: 0.8, max_mm: 3, verify: 0.02}
struct HelmetFile {
  std::string name;
  Head head;                  ///< target.mesh, units, up, front, crown, coverage_mm
  HelmetWish wish = {};       ///< target.ribs, spacing_mm, clearance_mm; structure; variables
  double rms_mm = 0.8;        ///< tolerance.rms_mm: of the distance to head plus clearance, > 0
  double max_mm = 3;          ///< tolerance.max_mm: likewise, the largest, > 0
  double verify = 0.02;       ///< tolerance.verify: of verify_rms, cell edges, (0, 1]
  SolverSection solver = {};  ///< ceres
  PhysicsSection physics = {};
};

/// @param root a target whose kind is helmet
/// @throws InvalidInput for whatever contracts.md does not allow, and what the mesh shows
HelmetFile read_helmet_file(const Node& root);

}  // namespace kinetix
