#pragma once

#include "app/pictures/panel_picture.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/run/run.hpp"
#include "app/run/search_result.hpp"
#include "optim/display/display_reading.hpp"
#include "optim/display/fit_display.hpp"
#include "targets/display/display_goal.hpp"
#include "targets/display/picture.hpp"

namespace kinetix::app {

/// Reading of a panel's state.
struct DisplayReading {
  std::vector<double> channel;  ///< value of each cell, in the channel's unit (optim::Channel)
  targets::DisplayScore score;
  double rank = 0;  ///< rank correlation of channel and levels, [-1, 1]
  /// Mean transmittance of letter and rest, blurred as from a distance, fractions of the lamp's light. Set for binary
  /// pictures that are read by another channel.
  std::optional<std::array<double, 2>> light = {};
  std::optional<targets::Topology> seen = {};  ///< distinguishable parts and holes of letters
};

/// Loads of a panel's drive and hinges, and the reading of the loaded state.
struct PanelLoads {
  HingeLoads hinges;
  double compression = 0;           ///< fraction of the plates' distance; NaN if a hinge is driven
  std::optional<double> turn = {};  ///< turn of the driven hinge, rad
  double auc = 0;                   ///< ratio, [0, 1]
  double contrast = 0;              ///< d', dimensionless
  double rank = 0;                  ///< rank correlation of channel and levels, [-1, 1]
  double stretch = 0;               ///< largest gap of a hinge, cell edges
  double apart = 0;                 ///< |mean of letter - mean of rest| / |mean of rest|, ratio
};

/// Print tolerance analysis of a panel.
struct PrintedDisplay {
  optim::DisplayTolerance expected;  ///< first-order estimate, corrected if the sampled prints differ from it
  optim::DisplayTolerance seen;      ///< sampled prints in their equilibrium
  double first_order_contrast = 0;   ///< mean first-order estimate for the sampled prints, dimensionless
  int prints = 0, failed = 0;  ///< counts of sampled prints that settled near the design, and that did not
  std::vector<std::string> why = {};  ///< requirements that prints miss; empty if they meet all

  bool holds() const { return why.empty(); }
  /// Returns whether the first-order estimate is close to the sampled prints; true if there are none.
  bool is_confirmed() const;
};

/// Display section of a result.
class DisplayOutcome final : public GoalOutcome {
 public:
  targets::DisplayGoal goal;
  optim::Channel channel = optim::Channel::aperture;
  optim::DisplayOptions options;
  optim::DisplayDesign design;
  DisplayReading exact;                 ///< strain-free state, if the search scales walls
  std::optional<PanelLoads> loads;      ///< loads of a panel with limits
  std::optional<PanelLoads> unlimited;  ///< loads without limits, if the limits made a difference
  double pressed = 1;                   ///< share of the drive's motion that keeps the limits
  std::optional<double> least_pressed;  ///< smallest share that exceeds the limits, if no share was accepted
  bool faint = false;           ///< a smaller share keeps the limits but letter and rest look the same
  bool limits_stopped = false;  ///< the search for a share was stopped before it found one

  /// Returns the name of the solver that found the design.
  std::string solver() const;

  /// Adds `display` (channel, levels and readings of all cells in the order of structure.cells, starts,
  /// reasons) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
  std::vector<NamedContent> pictures(const Run& run, bool for_report) const override;
};

class DisplayMeasure final : public Measure {
 public:
  DisplayReading reading;
  // Set only for the equilibrium under the drive, not for the simulation:
  DisplayReading before;                        ///< flat
  double stretch = 0;                           ///< largest gap of a hinge, cell edges
  std::optional<targets::PanelSize> estimated;  ///< estimated size of a panel with enough contrast, in cells
  std::optional<PrintedDisplay> printed;        ///< print tolerance analysis, for pictures of two levels
};

/// Draws the pictures of a run's panel. `before`, `after` and `hinges` (the map of t) are .svg and .png, and so is
/// `physics` if a simulation settled. `afar_before.png` and `afar_after.png` (far_view) are in true luminance. Names
/// with `_enhanced` have stretched contrast. The motion is in `frames/00.png` and on.
std::vector<NamedContent> display_pictures(const Run& run);

/// Returns the settings of the view from a distance. Panels with more cells are seen from further away. Large panels
/// are seen with their surroundings, because an eye adapts to the light of a large panel.
FarViewOptions far_view_options(const targets::DisplayGoal& goal);
/// Draws only the four pictures from a distance.
std::vector<NamedContent> far_pictures(const Run& run);

}  // namespace kinetix::app
