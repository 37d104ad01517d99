#pragma once

#include "app/files/goal_settings.hpp"
#include "app/files/structure_section.hpp"
#include "model/base/geometry.hpp"
#include "optim/ribs/fit_ribs.hpp"
#include "targets/surface/surface_patch.hpp"

namespace kinetix::app {

/// Content of a target.yaml of kind surface, with defaults filled in. Angles in radians, lengths in mm. Required are
/// `kinetix: 1` and a `target`.
///
///     target: {kind: surface, shape: cap, width_mm: 100, arc_deg: 60}
///     structure: {facets: [8, 8], wall_mm: {thickness: 0.4, height: 0.8}}
///     variables: {beta_deg: 75, theta_deg: 14, sector_deg: [60, 120], edge: [0.75, 1.3]}
///     tolerance: {shape: 0.015, verify: 0.02}
struct SurfaceFile : GoalSettings {
  targets::SurfacePatch patch;
  int columns = 8, rows = 8;              ///< structure.facets, each in [2, 24]
  ThinWalls walls = {};                   ///< structure.wall_mm
  double theta = 0.25;                    ///< variables.theta_deg, rad, (0, 0.7]
  double tilt = 75 * radians_per_degree;  ///< variables.beta_deg, rad
  std::array<double, 2> sector = {60 * radians_per_degree,
                                  120 * radians_per_degree};  ///< variables.sector_deg
  std::array<double, 2> edge = {0.75, 1.3};                   ///< variables.edge, ratio to the mean edge
  double shape_tolerance = 0.015;                             ///< rms error over the diagonal, (0, 1]
  double cover_tolerance = 0.75;                              ///< least share of the area, [0, 1]
  double curvature_tolerance = 0.5;                           ///< least share of the curvature, [0, 1]

  /// Returns the size of walls for a sheet with this mean wall length, mm.
  model::CellSize size(double edge_mm) const { return walls.size(edge_mm); }
};

/// Default of `tolerance.covered_share` for ribs over a surface, ratio: less no longer shows the surface.
inline constexpr double default_covered_share = 0.5;

/// Input limit of `target.ribs`: one rib per two millimetres of 400 mm.
inline constexpr int max_ribs = 200;

/// Returns all keys of a target.yaml of kind surface.
const targets::KeyTable& surface_file_keys();

/// Reads the target. @param root a target whose kind is surface
/// @throws InvalidInput for whatever formats.md does not allow, and for a surface that curves too much for its facets
SurfaceFile read_surface_file(const targets::Node& root);

/// Makes the goal: the search, the closed form, and the simulation.
std::unique_ptr<Goal> make_goal(SurfaceFile file);

/// Content of a target.yaml of kind surface with `target.ribs`: a fishbone over any surface.
///
///     target: {kind: surface, mesh: seat.obj, ribs: 8}
///     structure: {cell_mm: 7, wall_mm: {thickness: 0.6, height: 1}}
///     variables: {beta_deg: 75}
///     tolerance: {shape: 0.015, covered_share: 0.5, verify: 0.02}
struct RibsFile : GoalSettings {
  std::string surface_name;
  targets::RibbedSurface surface;
  optim::RibsSpec spec = {};       ///< target.ribs, structure, variables
  double shape_tolerance = 0.015;  ///< largest rms distance of bodies, over the surface's diagonal, (0, 1]
  /// Least share of the area within a cell edge of a rib, [0, 1].
  double covered_tolerance = default_covered_share;
};

/// Returns the default specification of n ribs without clearance. Cells leave room for one cell between two ribs and
/// are at most 1/25 of the surface's diagonal when folded. @param ribs >= 1
optim::RibsSpec default_ribs(const targets::RibbedSurface& surface, int ribs);

/// Reads the target. @param root a target of kind surface that has `ribs`
/// @throws InvalidInput for whatever formats.md does not allow
RibsFile read_ribs_file(const targets::Node& root);

/// Makes the goal: layout, fit of all tilts and theta, the same ribs loose for comparison, and the simulation.
std::unique_ptr<Goal> make_goal(RibsFile file);

}  // namespace kinetix::app
