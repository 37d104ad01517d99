#pragma once

#include <nlohmann/json_fwd.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "optim/ribs/fit_ribs.hpp"

namespace kinetix::app {

/// One way to make a surface, for comparison.
struct SurfaceWay {
  std::string name;  ///< "sheet", "fishbone", "loose ribs"
  double
      rms = 0,
      max =
          0;  ///< distance from the surface over the diagonal: of a sheet's vertices from their layers, of a rib's bodies
  int pieces = 1;
  double open = 0;  ///< share of the surface left bare
};

SurfaceWay fishbone_way(const optim::RibsDesign& design, const targets::RibbedSurface& surface);

/// Loose ribs, and before them the fishbone where `with_fishbone`; nothing where it is told to stop.
/// @throws InvalidInput as optim::fit_ribs
std::vector<SurfaceWay> ways_by_ribs(const targets::RibbedSurface& surface, const optim::RibsSpec& spec,
                                     bool with_fishbone, const std::stop_token& stop);

nlohmann::ordered_json ways_json(const std::vector<SurfaceWay>& ways);
/// In one line.
std::string in_words(const std::vector<SurfaceWay>& ways);

}  // namespace kinetix::app
