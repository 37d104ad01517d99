#pragma once

#include <nlohmann/json_fwd.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "optim/ribs/fit_ribs.hpp"

namespace kinetix::app {

/// One way to make a surface, for comparison. Distances are ratios to the diagonal of the surface.
struct SurfaceMethod {
  std::string name;         ///< "sheet", "fishbone", "loose ribs"
  double rms = 0, max = 0;  ///< distance of a sheet's vertices from their layers, or of a rib's bodies
  int pieces = 1;
  double open = 0;  ///< share of the surface left bare
};

/// Returns the distances of a fishbone design from the surface and the share of the area that it leaves open.
SurfaceMethod fishbone_way(const optim::RibsDesign& design, const targets::RibbedSurface& surface);

/// Fits loose ribs, and a fishbone first if `with_fishbone` is set. Returns an empty list if `stop` was requested.
/// @throws InvalidInput as optim::fit_ribs
std::vector<SurfaceMethod> ways_by_ribs(const targets::RibbedSurface& surface, const optim::RibsSpec& spec,
                                        bool with_fishbone, const std::stop_token& stop);

nlohmann::ordered_json ways_json(const std::vector<SurfaceMethod>& ways);
/// Describes all ways in one line.
std::string in_words(const std::vector<SurfaceMethod>& ways);

}  // namespace kinetix::app
