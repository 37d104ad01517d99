#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/pipeline/hinge_loads.hpp"
#include "app/run/found.hpp"
#include "optim/display/as_made_display.hpp"
#include "optim/display/fit_display.hpp"
#include "targets/display/display_goal.hpp"
#include "targets/display/topology.hpp"

namespace kinetix::app {

/// What a state of a panel shows.
struct DisplayReading {
  std::vector<double> channel;  ///< of each cell, in its unit (optim::Channel)
  targets::DisplayScore score;
  double rank = 0;  ///< rank correlation of channel and levels, [-1, 1]
  /// Mean transmittance of letter and rest, blurred as from a distance, fractions of the lamp's light; of binary pictures
  /// that are read by another channel.
  std::optional<std::array<double, 2>> light = {};
  std::optional<targets::Topology> seen = {};  ///< parts and holes of letters that can be told apart
};

/// What a panel asks of who presses it and of its hinges, and what it shows.
struct PanelLoads {
  HingeLoads hinges;
  double compression = 0;           ///< fraction of the plates' distance; NaN where a hinge is driven
  std::optional<double> turn = {};  ///< of that hinge, rad
  double auc = 0;                   ///< ratio, [0, 1]
  double contrast = 0;              ///< d', dimensionless
  double rank = 0;                  ///< rank correlation of channel and levels, [-1, 1]
  double stretch = 0;               ///< largest gap of a hinge, cell edges
  double apart = 0;  ///< of the means of letter and rest, over that of the rest, without sign; ratio
};

/// What prints of a panel show.
struct PrintedDisplay {
  optim::AsMadeDisplay
      expected;  ///< to first order, corrected where the prints that were looked at differ from it
  optim::AsMadeDisplay seen;        ///< in prints that were brought to their equilibrium
  double first_order_contrast = 0;  ///< dimensionless, of the same prints, as first order has each of them
  int prints = 0, failed = 0;       ///< of those: that settled near the design, and that did not
  std::vector<std::string> why =
      {};  ///< prints do not show the picture as it was asked for; empty where they do

  bool holds() const { return why.empty(); }
  /// Whether first order comes near to the prints that were looked at; true where there are none.
  bool is_confirmed() const;
};

/// What a search for a display contributes to a result.
class DisplayOutcome final : public GoalOutcome {
 public:
  targets::DisplayGoal goal;
  optim::Channel channel = optim::Channel::aperture;
  optim::DisplayOptions options;
  optim::DisplayDesign design;
  DisplayReading exact;                 ///< of a search by the scales of walls: its state, without any strain
  std::optional<PanelLoads> loads;      ///< of a panel with limits
  std::optional<PanelLoads> unlimited;  ///< what it would be without them, where they made a difference
  double pressed = 1;                   ///< part of the drive's way that they leave
  std::optional<double>
      least_pressed;            ///< the smallest part that was tried, where none that was tried keeps them
  bool faint = false;           ///< a smaller part does, but then an eye does not tell letter and rest apart
  bool limits_stopped = false;  ///< the search for such a part was, before it found one

  /// What found the design, in words.
  std::string solver() const;

  /// Adds `display` (channel, levels and readings of all cells in the order of structure.cells, starts,
  /// reasons) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
  std::vector<NamedContent> pictures(const Run& run, bool of_report) const override;
};

class DisplayMeasure final : public Measure {
 public:
  DisplayReading reading;
  // Set for the equilibrium under the drive alone, not for the physics run:
  DisplayReading before;  ///< flat
  double stretch = 0;     ///< largest gap of a hinge, cell edges
  std::optional<targets::PanelSize>
      estimated;  ///< an estimate of the panel that is clear enough, if this one is not
  std::optional<PrintedDisplay> printed;  ///< of pictures of two levels
};

}  // namespace kinetix::app
