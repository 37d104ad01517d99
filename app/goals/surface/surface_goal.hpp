#pragma once

#include "app/goals/ribs/ribs_goal.hpp"
#include "app/goals/surface/surface_file.hpp"
#include "app/run/search_result.hpp"
#include "model/lattice/origami/origami_sheet.hpp"
#include "optim/surface/fit_surface.hpp"
#include "targets/surface/gauss_curvature.hpp"

namespace kinetix::app {

/// Largest rms of a doubly curved sheet, as a ratio to the rms of the best cylinder or cone. A sheet with a larger rms
/// could itself be a cylinder or cone.
inline constexpr double most_of_cone = 0.5;

/// Surface section of a result. The goal is met if the vertices are within tolerance of the surface's layers, all
/// bounds are kept and no walls collide.
class SurfaceOutcome final : public GoalOutcome {
 public:
  explicit SurfaceOutcome(SurfaceFile asked) : file(std::move(asked)) {}

  SurfaceFile file;
  optim::SurfaceDesign design;
  model::State exact;                  ///< exact state, aligned with the surface
  double free_height = 0;              ///< largest plate height without collisions, cell edges
  bool clear = false;                  ///< no walls collide at the present height
  double diagonal_mm = 0;              ///< diagonal of the surface's bounding box
  targets::GaussShare curvature = {};  ///< curvature of the sheet's middle over the surface's
  double cone_rms = 0;  ///< rms of the surface from the best cylinder or cone, over the diagonal

  /// Returns whether the surface is so doubly curved that a sheet bent in one direction cannot match it.
  bool needs_curvature() const { return curvature.wanted > targets::double_curvature_threshold; }

  /// Adds `surface` (grid of the surface, vertices of the mesh, errors) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

class SurfaceMeasure final : public Measure {
 public:
  std::vector<SurfaceMethod>
      methods;  ///< the sheet, a fishbone with one rib per facet, and the same ribs loose
};

/// Describes violations of the tolerances, bounds and collision limits, one sentence each.
std::vector<std::string> violations(const SurfaceOutcome& outcome);

}  // namespace kinetix::app
