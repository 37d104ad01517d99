#pragma once

#include "app/files/goal_settings.hpp"
#include "optim/ribs/fit_ribs.hpp"
#include "targets/helmet/head.hpp"

namespace kinetix::app {

/// Content of a target.yaml of kind helmet, with defaults filled in. Required are `kinetix: 1` and a `target` with a
/// mesh. Either ribs or spacing_mm is given.
///
/// `target: {kind: helmet, mesh: head.obj, units: mm, up: z, front: -y, crown: [x, y, z], ribs: 8, spacing_mm: 40,
///           coverage_mm: 90, clearance_mm: 5}`
/// `structure: {cell_mm: 6, wall_mm: {thickness: 0.6, height: 3.6}}`
/// `variables: {beta: {range_deg: [-60, 60]}, theta: {range_deg: [2, 40]}}`
/// `tolerance: {rms_mm: 0.8, max_mm: 3, verify: 0.02}`
struct HelmetFile : GoalSettings {
  /// Default tolerances in mm, small compared with the default clearance of 5 mm.
  static constexpr double default_rms_mm = 0.8, default_max_mm = 3;

  targets::Head head;                        ///< target.mesh, units, up, front, crown, coverage_mm
  optim::RibsSpec spec = {};                 ///< target.ribs, spacing_mm, clearance_mm; structure; variables
  double rms_mm = default_rms_mm;            ///< tolerance.rms_mm: rms distance from head plus clearance, > 0
  double max_mm = default_max_mm;            ///< tolerance.max_mm: largest error of that distance, > 0
  std::optional<double> covered_share = {};  ///< tolerance.covered_share, [0, 1]; nullopt: no limit
};

/// Largest number of evaluations of the search: second-order steps need few.
inline constexpr int helmet_evaluations = 120;

/// Returns all keys of a target.yaml of kind helmet.
const targets::KeyTable& helmet_keys();

/// Reads the target. @param root a target whose kind is helmet
/// @throws InvalidInput for whatever formats.md does not allow, and for an unsuitable mesh
HelmetFile read_helmet_file(const targets::Node& root);

/// Makes the goal: layout, fit of all tilts and theta, and the simulation of its folding. All states are in the frame
/// of the mesh, mm.
std::unique_ptr<Goal> make_goal(HelmetFile file);

}  // namespace kinetix::app
