#pragma once

#include "model/base/progress.hpp"
#include "model/lattice/lattice.hpp"
#include "optim/display/display_search.hpp"
#include "optim/display/scaled_display.hpp"

namespace kinetix::optim {

/// One start of the search.
struct DisplayStart {
  std::string name;
  DisplayView view;  ///< before the search
  double cost = 0;   ///< after its first stage, stretch penalty included: PictureCost::for_separation, in the
                     ///< channel's unit squared
  SolveStatus status = SolveStatus::failed;
  bool sharpened = false;  ///< whether it was one of those in the second stage
};

struct DisplayDesign {
  DisplayView view;                  ///< of the best start, its equilibrium found anew from flat
  std::vector<DisplayStart> starts;  ///< all starts of the first axis, then of the second
  SolveStatus status = SolveStatus::failed;
  std::string why;
  int evaluations = 0, paths_from_flat = 0;
  std::optional<ScaledDisplay> scaled = {};  ///< of a search by the scales of walls
  bool refined = false;                      ///< whether its view strains hinges on purpose
};

/// Searches by the scales of walls along each axis and returns the clearest result. The view's state is the
/// exact one: no hinge stretches.
/// @param axes normals of the plates, at least one, and exactly one if a hinge is driven. The axis of the
/// options has no effect.
/// @param panel, levels as for fit_display
/// @throws InvalidInput for options out of range
DisplayDesign fit_scaled_display(const model::Lattice& panel, const std::vector<double>& levels,
                                 Channel channel, const std::vector<model::Axis>& axes,
                                 const ScaledDisplayOptions& options);

/// Refines a design of fit_scaled_display() by straining hinges on purpose. It varies t, offsets and, if it
/// has a range, the compression. The aim is the highest contrast of the equilibrium between the plates, with
/// no hinge stretched by more than options.stretch. The result replaces the view if it is clearer than the
/// equilibrium of the given design.
/// @param options its offset is the largest of a hinge, above 0; start, axes and symmetry have no effect
void refine_display(const model::Lattice& panel, const std::vector<double>& levels,
                    const DisplayOptions& options, DisplayDesign& design);

/// Reads the unchanged panel at its equilibrium along the path from flat.
DisplayView view_display(const model::Structure& panel, const std::vector<double>& levels,
                         const DisplayOptions& options);

/// Searches a display in parallel. Every start along every axis first aims at options.separation; the best
/// two then aim at the highest contrast. The result is the clearest of all views found that is within the
/// limit of stretch. The same options give the same result for any number of threads.
/// @param panel basic cells that fill a rectangle.
/// @param levels of each of its cells, 0 to 1, not all the same.
/// @param progress a short text and the share done.
/// @throws InvalidInput for invalid options or an unsuitable panel
DisplayDesign fit_display(const model::Structure& panel, const std::vector<double>& levels,
                          const DisplayOptions& options, const Progress& progress = {});

}  // namespace kinetix::optim
