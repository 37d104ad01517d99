#pragma once

#include <string>

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

struct FarViewOptions {
  double pixels_per_cell = 12;  ///< px a cell edge, > 0
  /// Cell edges, standard deviation of the Gaussian that the eye's distance makes.
  double blur_in_cells = 0.6;
  /// Cell edges, standard deviation of the neighbourhood that the light of each place is held against, as an eye
  /// adapts; 0: against none.
  double surroundings_in_cells = 0;
  bool bright_is_ink = true;  ///< whether bright is drawn dark, as ink on white paper
};

/// A planar panel before a lamp as seen from a distance: the light through its openings, blurred to about a
/// cell, relative to the panel's own blurred outline, contrast stretched from the second to the
/// ninety-eighth percentile of what is not near the rim, on white, with a margin of two cells. @return a PNG @throws std::runtime_error for a state that is not finite
std::string far_view(const model::Linkage& panel, const model::State& state,
                     const FarViewOptions& options = {});

}  // namespace kinetix::app
