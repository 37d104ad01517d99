#include "app/goals/display/display_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/goals/display/search_panel.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/matter/hinge_strain.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

// Of a search for the largest compression that keeps the limits: to a hundredth of the compression asked for.
constexpr int halvings = 7;
constexpr double least_share = 0.1;  // of the compression: below, there is nothing to see
// Kept in hand, so that the run from flat with its own steps keeps the limits too.
constexpr double in_hand = 0.99;

/// The worst of all loads over its limit; infinite where the panel finds no equilibrium.
double share_of_limits(const DisplayFile& file, const PanelLoads& loads) {
  if (!loads.reached) return INFINITY;
  double share = 0;
  if (file.force_N) share = std::max(share, loads.force_N / *file.force_N);
  if (file.most_strain) share = std::max(share, loads.strain / *file.most_strain);
  return share;
}

DisplayFile pressed_by(DisplayFile file, double compression) {
  file.compression = compression;
  file.compression_range.reset();
  return file;
}

}  // namespace

PanelLoads panel_loads(const DisplayFile& file, const model::Sheet& basic, const optim::DisplayView& view,
                       const model::Elasticity& elasticity) {
  model::Sheet panel = basic;
  place_hinges(view, panel);
  model::EquilibriumPathOptions options;
  options.planar = true;
  const model::EquilibriumPath path =
      trace_equilibrium({panel, drive_on(panel, view), exact_motion(panel)}, elasticity, options);
  PanelLoads loads;
  loads.reached = path.stop == model::EquilibriumPath::Stop::reached;
  loads.compression = view.plates.compression;
  loads.force_N = largest_load(path);
  const model::Linkage linkage(panel);
  for (int h = 0; file.hinge.made && h < panel.hinges(); ++h)
    loads.strain = std::max(loads.strain, hinge_strain(*file.hinge.made, linkage, path.state, h));
  const DisplayReading seen = read_panel(file, panel, path.state);
  loads.auc = seen.score.auc;
  loads.contrast = seen.score.contrast;
  return loads;
}

void keep_limits(const DisplayFile& file, const model::Elasticity& elasticity, DisplayOutcome& display,
                 model::Sheet& panel, const std::function<optim::DisplayDesign(const DisplayFile&)>& search) {
  if (!file.force_N && !file.most_strain) return;
  display.loads = panel_loads(file, panel, display.design.view, elasticity);
  if (share_of_limits(file, *display.loads) <= in_hand) return;
  display.unlimited = display.loads;
  double kept = 0, too_much = 1;
  for (int k = 0; k < halvings; ++k) {
    const double share = k == 0 ? least_share : (kept + too_much) / 2;
    optim::DisplayDesign design = search(pressed_by(file, share * file.compression));
    const PanelLoads loads = panel_loads(file, panel, design.view, elasticity);
    if (!(share_of_limits(file, loads) <= in_hand)) {
      too_much = share;
      if (k == 0) return;
      continue;
    }
    kept = share;
    display.design = std::move(design);
    display.loads = loads;
  }
}

std::vector<std::string> limit_violations(const DisplayFile& file, const PanelLoads& loads) {
  std::vector<std::string> why;
  if (file.force_N && !(loads.force_N <= *file.force_N))
    why.push_back(
        fmt::format("the plates take {:.3g} N; at most {:g} N is allowed, and less compression "
                    "does not keep that either",
                    loads.force_N, *file.force_N));
  if (file.most_strain && !(loads.strain <= *file.most_strain))
    why.push_back(
        fmt::format("a hinge is strained by {:.2f}; at most {:g} is allowed, and less compression "
                    "does not keep that either: a longer gap or a thinner hinge strains less",
                    loads.strain, *file.most_strain));
  return why;
}

}  // namespace kinetix::app
