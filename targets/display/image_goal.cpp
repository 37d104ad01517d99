#include "targets/display/image_goal.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "targets/display/whole_picture.hpp"

namespace kinetix::targets {
namespace {

PanelSize default_size(const Picture& picture, double cell_shape) {
  const double rows =
      std::round(cell_shape * static_cast<double>(default_image_columns) * picture.height / picture.width);
  return {default_image_columns, static_cast<int>(std::max(rows, 1.0))};
}

DisplayGoal shown(const std::shared_ptr<const Picture>& picture, PanelSize size, ImageLevels levels,
                  bool inverted) {
  check_panel(size);
  const auto window = [&](PanelSize) { return frame(*picture); };
  DisplayGoal goal = levels == ImageLevels::two
                         ? sampled(*picture, window, size)
                         : make_goal(size, ink_coverage(*picture, frame(*picture), size));
  if (levels == ImageLevels::two) compare_with(*picture, window, goal);
  check_contrast(goal);
  goal.inverted = inverted;
  goal.redrawn = [=](PanelSize other) { return shown(picture, other, levels, inverted); };
  return goal;
}

}  // namespace

DisplayGoal image_goal(const std::string& file, std::optional<PanelSize> size, ImageLevels levels,
                       bool invert, double cell_shape) {
  const auto picture = std::make_shared<const Picture>(read_image(file, levels, invert));
  return shown(picture, size.value_or(default_size(*picture, cell_shape)), levels, invert);
}

}  // namespace kinetix::targets
