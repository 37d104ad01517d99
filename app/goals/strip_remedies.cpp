#include "app/goals/strip_remedies.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "model/base/geometry.hpp"

namespace kinetix::app {
namespace {

using targets::DocumentChanges;

constexpr std::array wider_tilts = {60, 75};  // degrees: the default, and the most that still prints
constexpr int largest_fold = 44;              // degrees: basic cells close at 45
constexpr double widest_position = 0.92;      // of a wall: nearer to its end a hinge meets the next wall
constexpr std::array more_columns = {1.5,
                                     2.0};  // ratios: a search of twice as many takes eight times as long
constexpr std::array fewer_columns = {0.75, 0.5};  // ratios: larger cells have more room for their walls
constexpr double thinner = 0.7;                    // ratio of walls

DocumentChanges with_columns(const MissedStrip& strip, int columns) {
  DocumentChanges out = {{"structure.cells", fmt::format("[{}, {}]", columns, strip.rows)}};
  // The strip keeps its length.
  if (strip.cell_mm && !strip.fitting_columns)
    out.emplace_back("structure.cell_mm", fmt::format("{:.5g}", *strip.cell_mm * strip.columns / columns));
  return out;
}

int scaled(int columns, double share) { return std::max(2, static_cast<int>(std::lround(share * columns))); }

DocumentChanges thinner_walls(const model::CellSize& size) {
  return {{"structure.wall_mm", fmt::format("{{thickness: {:.3g}, height: {:.3g}}}",
                                            thinner * size.thickness_mm, thinner * size.height_mm)}};
}

/// Returns one change for each range of a column that is narrower than it may be.
std::vector<DocumentChanges> wider_ranges(const MissedStrip& strip) {
  std::vector<DocumentChanges> all;
  const auto wider = std::find_if(wider_tilts.begin(), wider_tilts.end(),
                                  [&](int deg) { return strip.tilt < (deg - 1) * radians_per_degree; });
  if (wider != wider_tilts.end())
    all.push_back({{"variables.tilt.range_deg", fmt::format("[{}, {}]", -*wider, *wider)}});
  if (strip.fold_angle.upper < (largest_fold - 1) * radians_per_degree)
    all.push_back({{"variables.fold_angle.range_deg",
                    fmt::format("[{:.4g}, {}]", to_degrees(strip.fold_angle.lower), largest_fold)}});
  if (strip.hinge_position && *strip.hinge_position < widest_position)
    all.push_back({{"variables.hinge_position.range",
                    fmt::format("[{:.4g}, {:.4g}]", 1 - widest_position, widest_position)}});
  return all;
}

}  // namespace

std::vector<DocumentChanges> strip_remedies(const MissedStrip& strip) {
  std::vector<DocumentChanges> all;
  DocumentChanges untied;
  for (const std::string& tie : strip.ties)
    untied.emplace_back("variables.tilt." + tie, tie == "per" ? "column" : "none");
  if (!untied.empty()) all.push_back(untied);
  if (strip.fitting_columns) all.push_back(with_columns(strip, *strip.fitting_columns));
  DocumentChanges together;
  for (const DocumentChanges& one : wider_ranges(strip)) {
    all.push_back(one);
    together.insert(together.end(), one.begin(), one.end());
  }
  if (strip.walls_meet) all.push_back(thinner_walls(strip.size));
  if (!strip.fitting_columns && !strip.is_steep)
    for (const double share : strip.walls_meet ? fewer_columns : more_columns)
      all.push_back(with_columns(strip, scaled(strip.columns, share)));
  if (strip.walls_meet && !strip.fitting_columns && !strip.is_steep)
    all.push_back(with_columns(strip, scaled(strip.columns, more_columns.front())));
  if (together.empty()) return all;
  if (!strip.is_steep) {
    const int columns = strip.fitting_columns.value_or(scaled(strip.columns, more_columns.back()));
    const DocumentChanges more = with_columns(strip, columns);
    together.insert(together.end(), more.begin(), more.end());
  }
  all.push_back(together);
  return all;
}

}  // namespace kinetix::app
