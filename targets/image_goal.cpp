#include "targets/image_goal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kinetix {
namespace {

PanelSize default_size(const Picture& picture) {
  const double rows = std::round(static_cast<double>(default_image_columns) * picture.height / picture.width);
  return {default_image_columns, static_cast<int>(std::max(rows, 1.0))};
}

}  // namespace

DisplayGoal image_goal(const std::string& file, std::optional<PanelSize> size, ImageLevels levels,
                       bool invert) {
  const Picture picture = read_image(file, levels, invert);
  const PanelSize panel = size.value_or(default_size(picture));
  check_panel(panel);
  auto coverage = ink_coverage(picture, frame(picture), panel);
  if (levels == ImageLevels::two) coverage = thresholded(std::move(coverage));
  return make_goal(panel, std::move(coverage));
}

}  // namespace kinetix
