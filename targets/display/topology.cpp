#include "targets/display/topology.hpp"

#include <leptonica/allheaders.h>

#include <cstddef>
#include <new>

#include "targets/display/display_score.hpp"
#include "targets/display/pix.hpp"

namespace kinetix::targets {
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
