#include "app/print/sheet/tiles.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

constexpr double rounding = 1e-9;  // of a tile: places on the line between two belong to the first

int parts_of(double span_mm, double room_mm) {
  return std::max(1, static_cast<int>(std::ceil(span_mm / room_mm - rounding)));
}

int part_at(double from_start_mm, double span_mm, int parts) {
  if (!(span_mm > 0)) return 0;
  return std::clamp(static_cast<int>(std::ceil(from_start_mm / span_mm * parts - rounding)) - 1, 0,
                    parts - 1);
}

}  // namespace

Tiles cut_into_tiles(const std::vector<Eigen::Vector2d>& places, double reach_mm,
                     const Eigen::Vector2d& bed_mm) {
  const Eigen::Vector2d room = bed_mm.array() - 2 * reach_mm;
  if (!(room.minCoeff() > 0))
    throw InvalidInput(fmt::format("a bed of {:g} x {:g} mm does not hold a body, which takes up to {:g} mm",
                                   bed_mm.x(), bed_mm.y(), 2 * reach_mm));
  Eigen::AlignedBox2d all;
  for (const Eigen::Vector2d& place : places) all.extend(place);
  const Eigen::Vector2d span = all.sizes();
  Tiles tiles{parts_of(span.x(), room.x()), parts_of(span.y(), room.y()), {}};
  for (const Eigen::Vector2d& place : places) {
    const Eigen::Vector2d at = place - all.min();
    tiles.of_body.push_back(part_at(at.y(), span.y(), tiles.rows) * tiles.columns +
                            part_at(at.x(), span.x(), tiles.columns));
  }
  return tiles;
}

}  // namespace kinetix::app
