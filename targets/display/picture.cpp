#include "targets/display/picture.hpp"

#include <algorithm>
#include <cstddef>

namespace kinetix::targets {
namespace {

/// Calls f(k, part of pixel k inside) for the pixels of [0, count) that reach into [from, to].
void for_pixels(double from, double to, int count, const auto& f) {
  from = std::max(from, 0.0);
  to = std::min<double>(to, count);
  for (int k = static_cast<int>(from); k < to; ++k)
    f(k, std::min<double>(to, k + 1) - std::max<double>(from, k));
}

/// Returns the start of cell k of `count` equal cells that fill [start, end].
double cell_edge(double start, double end, int k, int count) { return start + (end - start) * k / count; }

/// Sums of ink in one pixel row under each column of cells. A row requested again at once is summed once.
class ColumnSums {
 public:
  ColumnSums(const Picture& picture, const Window& window, int columns)
      : picture_(picture), window_(window), sums_(columns) {}

  const std::vector<double>& of_row(int y) {
    if (y == row_) return sums_;
    row_ = y;
    const std::uint8_t* pixels = picture_.ink.data() + static_cast<std::size_t>(y) * picture_.width;
    const int columns = static_cast<int>(sums_.size());
    for (int i = 0; i < columns; ++i) {
      sums_[i] = 0;
      for_pixels(cell_edge(window_.left, window_.right, i, columns),
                 cell_edge(window_.left, window_.right, i + 1, columns), picture_.width,
                 [&](int x, double part) { sums_[i] += part * pixels[x]; });
    }
    return sums_;
  }

 private:
  const Picture& picture_;
  const Window& window_;
  std::vector<double> sums_;
  int row_ = -1;
};

}  // namespace

Window frame(const Picture& picture) {
  return {0, static_cast<double>(picture.width), 0, static_cast<double>(picture.height)};
}

std::vector<double> ink_coverage(const Picture& picture, const Window& window, PanelSize size) {
  const int columns = size[0], rows = size[1];
  const double full = 255 * ((window.right - window.left) / columns) * ((window.bottom - window.top) / rows);
  ColumnSums sums(picture, window, columns);
  std::vector<double> levels(static_cast<std::size_t>(columns) * rows);
  for (int row = 0; row < rows; ++row) {
    double* const cells = &levels[static_cast<std::size_t>(rows - 1 - row) * columns];
    for_pixels(cell_edge(window.top, window.bottom, row, rows),
               cell_edge(window.top, window.bottom, row + 1, rows), picture.height, [&](int y, double part) {
                 const auto& inked = sums.of_row(y);
                 for (int i = 0; i < columns; ++i) cells[i] += part * inked[i];
               });
    for (int i = 0; i < columns; ++i) cells[i] = std::min(cells[i] / full, 1.0);
  }
  return levels;
}

}  // namespace kinetix::targets
