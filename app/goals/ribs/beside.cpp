#include "app/goals/ribs/beside.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "targets/document/wording.hpp"

namespace kinetix::app {

SurfaceMethod fishbone_way(const optim::RibsDesign& design, const targets::RibbedSurface& surface) {
  return {"fishbone", design.error.rms / surface.diagonal, design.error.max / surface.diagonal, 1,
          optim::open_area(static_cast<int>(design.fishbone.structure.cells.size()),
                           design.fishbone.structure.size, design.shape.theta, surface.area)};
}

std::vector<SurfaceMethod> ways_by_ribs(const targets::RibbedSurface& surface, const optim::RibsSpec& spec,
                                        bool with_fishbone, const std::stop_token& stop) {
  std::vector<SurfaceMethod> out;
  optim::SolverOptions search;
  search.stop = stop;
  if (stop.stop_requested()) return out;
  if (with_fishbone) out.push_back(fishbone_way(fit_ribs(surface, spec, search), surface));
  if (stop.stop_requested()) return {};
  const optim::LooseRibs loose = fit_loose_ribs(surface, spec, search);
  if (stop.stop_requested()) return {};
  out.push_back(
      {"loose ribs", loose.rms / surface.diagonal, loose.max / surface.diagonal, loose.pieces, loose.open});
  return out;
}

nlohmann::ordered_json ways_json(const std::vector<SurfaceMethod>& ways) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const SurfaceMethod& way : ways)
    out.push_back({{"way", way.name},
                   {"rms", way.rms},
                   {"max", way.max},
                   {"pieces", way.pieces},
                   {"open_area", way.open}});
  return out;
}

std::string in_words(const std::vector<SurfaceMethod>& ways) {
  std::string out;
  for (const SurfaceMethod& way : ways)
    out += fmt::format("{}{}: {}, {:.3f} % of the diagonal off, {:.0f} % of the area open",
                       out.empty() ? "" : "; ", way.name,
                       targets::counted(static_cast<std::size_t>(way.pieces), "piece"), 100 * way.rms,
                       100 * way.open);
  return out;
}

}  // namespace kinetix::app
