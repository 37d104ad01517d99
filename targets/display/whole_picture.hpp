#pragma once

#include "targets/display/picture.hpp"

namespace kinetix::targets {

/// Function from the size of a panel to its window on a picture.
using PanelWindow = std::function<Window(PanelSize)>;

/// Check that panels show a picture whole: with all parts and holes, and no stroke lost.
///
/// Specks, parts and holes under a five-hundredth of the ink, do not count: they are noise, dust and dots of a raster.
/// Each quarter of a cell is compared with its cell and the three cells that it touches, by an edge or a corner. A
/// stroke, or a gap between strokes, is lost there if none of these cells is of its kind. The thin tips of sharp
/// corners are lost on every panel, so up to a twenty-fifth of the ink may be lost.
class WholePicture {
 public:
  explicit WholePicture(const Picture& picture);

  /// @param goal the picture's cells on a panel that fills the window, binary
  bool shown_by(const DisplayGoal& goal, const Window& window) const;

 private:
  bool keeps_strokes(const DisplayGoal& goal, const Window& window) const;

  Picture clean_;     ///< without specks, of two levels; large pictures reduced to grey
  double scale_ = 1;  ///< pixels of clean_ per pixel of the picture
  Topology topology_;
};

/// Samples the picture on a panel: a cell is letter if ink covers at least half of it.
DisplayGoal sampled(const Picture& picture, const PanelWindow& window, PanelSize size);

/// Sets `whole` and `needed` of a goal that was sampled from the picture.
void compare_with(const Picture& picture, const PanelWindow& window, DisplayGoal& goal);

}  // namespace kinetix::targets
