#include "targets/topology.hpp"

#include <leptonica/allheaders.h>

#include <cstddef>
#include <new>

#include "targets/pix.hpp"

namespace kinetix {
namespace {

/// One bit a pixel, with a rim of paper one pixel wide all round, so that all paper outside is one piece.
PixPointer binary(int width, int height, const auto& is_ink) {
  PixPointer pix = owned(pixCreate(width + 2, height + 2, 1));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (is_ink(x, y)) pixSetPixel(pix.get(), x + 1, y + 1, 1);
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

}  // namespace

Topology topology(const Picture& picture) {
  return topology(binary(picture.width, picture.height, [&](int x, int y) {
    return picture.ink[static_cast<std::size_t>(y) * picture.width + x] >= 128;
  }));
}

Topology topology(const DisplayGoal& goal) {
  return topology(binary(goal.columns, goal.rows, [&](int i, int j) { return goal.is_letter(i, j); }));
}

}  // namespace kinetix
