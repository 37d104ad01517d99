#include "targets/display/picture.hpp"

#include <leptonica/allheaders.h>
#include <new>

namespace kinetix::targets {

void PixDeleter::operator()(Pix* pix) const { pixDestroy(&pix); }

PixPointer owned(Pix* pix) {
  if (pix == nullptr) throw std::bad_alloc();
  return PixPointer(pix);
}

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

namespace {

constexpr int tried_levels =
    16;  // steps between the means of rest and letter, since an eye sets its level itself

l_uint32* line_of(const PixPointer& pix, int y) {
  return pixGetData(pix.get()) + static_cast<std::size_t>(y) * pixGetWpl(pix.get());
}

/// Makes a picture of one bit per pixel, with a border of paper one pixel wide that joins all paper outside.
PixPointer binary(int width, int height, const auto& is_ink) {
  PixPointer pix = owned(pixCreate(width + 2, height + 2, 1));
  for (int y = 0; y < height; ++y) {
    l_uint32* const line = line_of(pix, y + 1);
    for (int x = 0; x < width; ++x)
      if (is_ink(x, y)) SET_DATA_BIT(line, x + 1);
  }
  return pix;
}

int count_components(PIX* pix, int connectivity) {
  l_int32 count = 0;
  if (pixCountConnComp(pix, connectivity, &count) != 0) throw std::bad_alloc();
  return count;
}

Topology topology(const PixPointer& ink) {
  const PixPointer paper = owned(pixInvert(nullptr, ink.get()));
  const int outside = 1;
  return {count_components(ink.get(), 8), count_components(paper.get(), 4) - outside};
}

PixPointer binary(const Picture& picture) {
  return binary(picture.width, picture.height, [&](int x, int y) {
    return picture.ink[static_cast<std::size_t>(y) * picture.width + x] >= 128;
  });
}

PixPointer without_small_parts(const PixPointer& pix, double area, int connectivity) {
  return owned(
      pixSelectByArea(pix.get(), static_cast<l_float32>(area), connectivity, L_SELECT_IF_GTE, nullptr));
}

PixPointer inverted(const PixPointer& pix) { return owned(pixInvert(nullptr, pix.get())); }

}  // namespace

Topology topology(const Picture& picture) { return topology(binary(picture)); }

Picture without_specks(const Picture& picture, double area) {
  const PixPointer ink = without_small_parts(binary(picture), area, 8);
  const PixPointer clean = inverted(without_small_parts(inverted(ink), area, 4));
  Picture out{picture.width, picture.height, std::vector<std::uint8_t>(picture.ink.size())};
  for (int y = 0; y < out.height; ++y) {
    const l_uint32* const line = line_of(clean, y + 1);
    for (int x = 0; x < out.width; ++x)
      out.ink[static_cast<std::size_t>(y) * out.width + x] = GET_DATA_BIT(line, x + 1) ? 255 : 0;
  }
  return out;
}

Topology seen_topology(const DisplayGoal& goal, const std::vector<double>& values) {
  const DisplayScore means = display_score(values, goal.levels);
  const auto above = [&](double level) {
    return topology(binary(goal.columns, goal.rows, [&](int i, int j) {
      return values[static_cast<std::size_t>(j) * goal.columns + i] > level;
    }));
  };
  const Topology drawn = topology(goal);
  for (int k = 1; k < tried_levels; ++k)
    if (above(means.rest + (means.letter - means.rest) * k / tried_levels) == drawn) return drawn;
  return above((means.letter + means.rest) / 2);
}

Topology topology(const DisplayGoal& goal) {
  return topology(binary(goal.columns, goal.rows, [&](int i, int j) { return goal.is_letter(i, j); }));
}

}  // namespace kinetix::targets
