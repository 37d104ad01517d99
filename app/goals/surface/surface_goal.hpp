#pragma once

#include "app/goals/ribs/beside.hpp"
#include "app/goals/surface/surface_file.hpp"
#include "app/run/found.hpp"
#include "model/lattice/origami/origami_sheet.hpp"
#include "optim/surface/fit_surface.hpp"
#include "targets/surface/gauss_curvature.hpp"

namespace kinetix::app {

/// Of the rms of the best cylinder or cone, at most of a sheet that curves both ways: another could be one of them.
inline constexpr double most_of_cone = 0.5;

/// What a search for a surface contributes to a result. Met: vertices on the surface's layers within tolerance, bounds
/// kept, no walls in the way.
class SurfaceOutcome final : public GoalOutcome {
 public:
  explicit SurfaceOutcome(SurfaceFile asked) : file(std::move(asked)) {}

  SurfaceFile file;
  optim::SurfaceDesign design;
  model::State exact;                  ///< on the surface
  double free_height = 0;              ///< largest height of plates with which no walls meet, cell edges
  bool clear = false;                  ///< none meet as they are
  double diagonal_mm = 0;              ///< of the surface's box
  targets::GaussShare curvature = {};  ///< of the sheet's middle over the surface's
  double cone_rms = 0;                 ///< of the surface from the best cylinder or cone, over the diagonal

  /// Whether the surface curves both ways by so much that a sheet which bends one way alone is not it.
  bool needs_curvature() const { return curvature.wanted > targets::curved_both_ways; }

  /// Adds `surface` (grid of the surface, vertices of the mesh, errors, what binds) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

class SurfaceMeasure final : public Measure {
 public:
  std::vector<SurfaceWay> ways;  ///< the sheet, a fishbone with a rib a facet, and the same ribs loose
};

/// What the design lacks, in sentences.
std::vector<std::string> violations(const SurfaceOutcome& outcome);

}  // namespace kinetix::app
