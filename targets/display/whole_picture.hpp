#pragma once

#include <functional>

#include "targets/display/picture.hpp"
#include "targets/display/topology.hpp"

namespace kinetix::targets {

/// Where a panel of some size lies on a picture.
using PanelWindow = std::function<Window(PanelSize)>;

/// Tells whether panels show a picture whole: in as many parts and with as many holes, and no stroke lost.
///
/// Specks, parts and holes under a five-hundredth of the ink, do not count: they are noise, dust and dots of
/// a raster. A stroke, or a gap between strokes, is lost where cells that hold some of it neither are of its
/// kind nor touch one that is, by an edge or a corner; the thin tips of sharp corners do that on every panel,
/// so that up to a twenty-fifth of the ink may be lost.
class WholePicture {
 public:
  explicit WholePicture(const Picture& picture);

  /// @param goal the picture's cells on a panel that fills the window, binary
  bool shown_by(const DisplayGoal& goal, const Window& window) const;

 private:
  bool keeps_strokes(const DisplayGoal& goal, const Window& window) const;

  Picture clean_;     ///< without specks, of two levels; large pictures reduced to grey
  double scale_ = 1;  ///< pixels of clean_ by one of the picture
  Topology topology_;
};

/// The picture's cells on a panel: letter where ink covers at least half of one.
DisplayGoal sampled(const Picture& picture, const PanelWindow& window, PanelSize size);

/// Sets `whole` and `needed` of a goal that was sampled from the picture.
void compare_with(const Picture& picture, const PanelWindow& window, DisplayGoal& goal);

}  // namespace kinetix::targets
