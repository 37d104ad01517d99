#pragma once

#include <optional>
#include <vector>

#include "app/goals/display/display_file.hpp"
#include "model/base/progress.hpp"
#include "optim/display/fit_display.hpp"

namespace kinetix::app {

/// Searches on larger panels for a picture that the one asked for cannot show within its bounds.
struct LargerPanels {
  std::vector<targets::PanelSize> tried;
  std::optional<targets::PanelSize>
      enough;  ///< the first that shows the picture as asked, in its equilibrium
};

/// What a view lacks of auc (rank correlation for grey goals) and contrast as the file asks, in words.
/// @param rank rank correlation, [-1, 1]
std::vector<std::string> violations(const DisplayFile& file, const targets::DisplayScore& score, double rank,
                                    const std::string& who);

/// The same search on panels 1.25, 1.5 and 2 times as large each way, up to 625 cells, until one shows the picture as the
/// panel asked for is judged: in the equilibrium of its hinges with contact, which has to come to the drive's goal, and
/// within the limits of force and strain. None for goals that cannot be redrawn.
/// @param progress hears of the panel searched, and the share done, 0 to 1
LargerPanels search_larger_panels(const DisplayFile& file, const optim::DisplayOptions& options,
                                  const Progress& progress);

}  // namespace kinetix::app
