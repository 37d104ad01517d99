#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/base/progress.hpp"
#include "model/lattice/lattice.hpp"
#include "optim/display/display_search.hpp"
#include "optim/display/scaled_display.hpp"

namespace kinetix::optim {

/// One start of the search.
struct DisplayStart {
  std::string name;
  DisplayView view;  ///< before the search
  double cost = 0;   ///< after its first stage: PictureCost::for_separation, in the channel's unit squared,
                     ///< and the penalty on stretch
  SolveStatus status = SolveStatus::failed;
  bool sharpened = false;  ///< one of those that went on to the second stage
};

struct DisplayDesign {
  DisplayView view;                  ///< of the best, its equilibrium found anew from flat
  std::vector<DisplayStart> starts;  ///< all of the first axis, then of the second
  SolveStatus status = SolveStatus::failed;
  std::string why;
  int evaluations = 0, paths_from_flat = 0;
  std::optional<ScaledDisplay> scaled = {};  ///< of a search by the scales of walls
  bool refined = false;                      ///< whether its view strains hinges on purpose
};

/// One search by the scales of walls along each axis, of which the clearest is taken. The view's state is the
/// exact one: no hinge stretches.
/// @param axes normals of the plates, at least one; that of the options has no effect. One where a hinge is driven
/// @param panel, levels as for fit_display   @throws InvalidInput for options out of range
DisplayDesign fit_scaled_display(const model::Lattice& panel, const std::vector<double>& levels,
                                 Channel channel, const std::vector<model::Axis>& axes,
                                 const ScaledDisplayOptions& options);

/// Strains a design of fit_scaled_display() on purpose: t, offsets and, where it has a range, the compression are
/// led towards the highest contrast of the equilibrium between the plates, while no hinge stretches by more than
/// options.stretch. What comes out takes the view's place where it is clearer than the equilibrium of the design as it
/// was.
/// @param options its offset is the largest of a hinge, above 0; start, axes and symmetry have no effect
void refine_display(const model::Lattice& panel, const std::vector<double>& levels,
                    const DisplayOptions& options, DisplayDesign& design);

/// The panel as it is: taken to its equilibrium from flat, and read.
DisplayView view_display(const model::Structure& panel, const std::vector<double>& levels,
                         const DisplayOptions& options);

/// From every start along every axis towards options.separation; the best two of them then towards the
/// highest contrast. Of all that came out on the way the clearest that keeps the limit of stretch. In
/// parallel; same options, same answer, for any number of threads.
/// @param panel basic cells that fill a rectangle   @param levels of each of its cells, 0 to 1, not all the
/// same
/// @param progress words and the share done
/// @throws InvalidInput for options or a panel that cannot be
DisplayDesign fit_display(const model::Structure& panel, const std::vector<double>& levels,
                          const DisplayOptions& options, const Progress& progress = {});

}  // namespace kinetix::optim
