#pragma once

#include <optional>
#include <vector>

#include "app/display_file.hpp"
#include "optim/fit_display.hpp"

namespace kinetix {

/// Searches on larger panels for a picture that the one asked for cannot show within its bounds.
struct LargerPanels {
  std::vector<PanelSize> tried;
  std::optional<PanelSize> enough;  ///< the first that shows the picture as asked, in the model
};

/// What a view lacks of auc (rank correlation for grey goals) and contrast as the file asks, in words.
std::vector<std::string> misses(const DisplayFile& file, const DisplayScore& score, double rank,
                                const std::string& who);

/// The same search on panels 1.25, 1.5 and 2 times as large each way, up to 625 cells, until one shows the
/// picture. None for goals that cannot be redrawn.
LargerPanels search_larger_panels(const DisplayFile& file, const DisplayOptions& options,
                                  const std::function<void(const std::string&, double)>& progress);

/// The level of each of the panel's cells.
std::vector<double> levels_of(const DisplayGoal& goal, const Structure& panel);

}  // namespace kinetix
