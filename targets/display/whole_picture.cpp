#include "targets/display/whole_picture.hpp"

#include <cmath>

namespace kinetix::targets {
namespace {

// Area of a part or a hole, as a fraction of the ink, below which it is noise. A larger one drops the dots of letters;
// a smaller one requires a panel to show dust.
constexpr double speck = 1.0 / 500;
// Largest lost area, as a fraction of the ink. Tips of sharp corners are lost on every panel, so less would refuse
// whole letters. More would let a stroke disappear.
constexpr double max_lost = 1.0 / 25;
// Largest side, px: two per cell of the longest allowed side, since strokes are found in quarters of cells.
constexpr int max_pixels_per_side = 2 * max_panel_side;

double share_of_ink(const Picture& picture) {
  double sum = 0;
  for (const std::uint8_t ink : picture.ink) sum += ink;
  return sum / 255;
}

Picture reduced(const Picture& picture) {
  const double factor =
      std::max(1.0, static_cast<double>(std::max(picture.width, picture.height)) / max_pixels_per_side);
  if (factor == 1) return picture;
  Picture out{std::max(1, static_cast<int>(picture.width / factor)),
              std::max(1, static_cast<int>(picture.height / factor)),
              {}};
  const std::vector<double> cells = ink_coverage(picture, frame(picture), {out.width, out.height});
  out.ink.resize(cells.size());
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      out.ink[static_cast<std::size_t>(y) * out.width + x] = static_cast<std::uint8_t>(
          std::lround(255 * cells[static_cast<std::size_t>(out.height - 1 - y) * out.width + x]));
  return out;
}

/// Whether the cell of quarter (x, y), or one of the three that the quarter touches, is of this kind.
bool is_near(const DisplayGoal& goal, int x, int y, bool letter) {
  const int i = x / 2, j = y / 2, beside = i + (x % 2 == 0 ? -1 : 1), above = j + (y % 2 == 0 ? -1 : 1);
  const auto is = [&](int column, int row) {
    return column >= 0 && column < goal.columns && row >= 0 && row < goal.rows &&
           goal.is_letter(column, row) == letter;
  };
  return is(i, j) || is(beside, j) || is(i, above) || is(beside, above);
}

/// Returns the panel of the same proportions whose shorter side has this many cells.
PanelSize in_proportion(PanelSize asked, int shorter) {
  const auto [least, most] = std::minmax(asked[0], asked[1]);
  const int longer = static_cast<int>(std::lround(static_cast<double>(most) * shorter / least));
  return asked[0] == least ? PanelSize{shorter, longer} : PanelSize{longer, shorter};
}

bool is_allowed(PanelSize size) {
  return std::max(size[0], size[1]) <= max_panel_side &&
         static_cast<long>(size[0]) * size[1] <= max_panel_cells;
}

}  // namespace

WholePicture::WholePicture(const Picture& picture) {
  const Picture clean = without_specks(picture, speck * share_of_ink(picture));
  topology_ = topology(clean);
  clean_ = reduced(clean);
  scale_ = static_cast<double>(clean_.width) / picture.width;
}

bool WholePicture::shown_by(const DisplayGoal& goal, const Window& window) const {
  return topology(goal) == topology_ && keeps_strokes(goal, window);
}

bool WholePicture::keeps_strokes(const DisplayGoal& goal, const Window& window) const {
  const Window scaled = {scale_ * window.left, scale_ * window.right, scale_ * window.top,
                         scale_ * window.bottom};
  const int columns = 2 * goal.columns, rows = 2 * goal.rows;
  const std::vector<double> quarters = ink_coverage(clean_, scaled, {columns, rows});
  double all = 0, lost = 0;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const double ink = quarters[static_cast<std::size_t>(y) * columns + x];
      all += ink;
      if (!is_near(goal, x, y, true)) lost += ink;
      if (!is_near(goal, x, y, false)) lost += 1 - ink;
    }
  return lost <= max_lost * all;
}

DisplayGoal sampled(const Picture& picture, const PanelWindow& window, PanelSize size) {
  DisplayGoal goal;
  goal.columns = size[0];
  goal.rows = size[1];
  goal.levels = thresholded(ink_coverage(picture, window(size), size));
  return goal;
}

void compare_with(const Picture& picture, const PanelWindow& window, DisplayGoal& goal) {
  const WholePicture all(picture);
  const PanelSize asked = {goal.columns, goal.rows};
  goal.whole = all.shown_by(goal, window(asked));
  if (goal.whole) return;
  for (int shorter = std::min(asked[0], asked[1]) + 1; is_allowed(in_proportion(asked, shorter)); ++shorter) {
    const PanelSize size = in_proportion(asked, shorter);
    if (!all.shown_by(sampled(picture, window, size), window(size))) continue;
    goal.needed = size;
    return;
  }
}

}  // namespace kinetix::targets
