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
  /// Whether the light is stretched from its second to its ninety-eighth percentile, as an eye adapts, instead of drawn in true
  /// luminance: then the picture must say that it is enhanced.
  bool enhanced = false;
  /// For programs that read dark ink on white paper: the negative, and white all round.
  bool negative = false, on_white = false;
};

/// A planar panel before a lamp as seen from a distance: the light through its openings, blurred to about a cell, relative to
/// the panel's own blurred outline. The lamp's full light is white, none is black (luminance, encoded as sRGB has it), black
/// all round, with a margin of two cells. @return a PNG @throws std::runtime_error for a state that is not finite
std::string far_view(const model::Linkage& panel, const model::State& state,
                     const FarViewOptions& options = {});

}  // namespace kinetix::app
