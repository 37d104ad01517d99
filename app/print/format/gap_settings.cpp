#include "app/print/format/gap_settings.hpp"

#include <algorithm>
#include <limits>

namespace kinetix::app {
namespace {

constexpr double usual_radius_mm = 0.049;  // mm: PrusaSlicer's default, which mends meshes
constexpr double share_of_gap = 0.4;       // of a clearance: a radius of a half would close it
constexpr double usual_foot_mm =
    0.2;  // mm: of PrusaSlicer's own printers: about half a line that is squashed

}  // namespace

std::optional<GapSettings> gap_settings(const PrintSheet& sheet) {
  double least = std::numeric_limits<double>::infinity();
  for (const model::HingePrint& hinge : sheet.hinges)
    if (hinge.made.kind == model::HingeKind::pin) least = std::min(least, hinge.made.clearance_mm);
  if (least == std::numeric_limits<double>::infinity()) return std::nullopt;
  return GapSettings{std::min(usual_radius_mm, share_of_gap * least),
                     sheet.process.spreads_on_bed ? usual_foot_mm : 0, 0};
}

}  // namespace kinetix::app
