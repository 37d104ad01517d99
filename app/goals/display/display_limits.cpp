#include "app/goals/display/display_limits.hpp"

#include "app/goals/display/search_panel.hpp"
#include "app/pipeline/hinge_loads.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

// Of a search for the largest compression that keeps the limits: to a hundredth of the compression asked for.
constexpr int press_halvings = 7;
constexpr double least_share = 0.1;  // of the compression: below, there is nothing to see

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
  loads.hinges = hinge_loads(path, drive_on(panel, view), panel, file.hinge);
  loads.compression = view.plates.compression;
  const DisplayReading seen = read_panel(file, panel, path.state);
  loads.auc = seen.score.auc;
  loads.contrast = seen.score.contrast;
  return loads;
}

void keep_limits(const DisplayFile& file, const model::Elasticity& elasticity, DisplayOutcome& display,
                 model::Sheet& panel, const std::function<optim::DisplayDesign(const DisplayFile&)>& search) {
  if (!file.limits.any()) return;
  display.loads = panel_loads(file, panel, display.design.view, elasticity);
  if (share_of(file.limits, display.loads->hinges) <= HingeLimits::in_hand) return;
  display.unlimited = display.loads;
  double kept = 0, too_much = 1;
  for (int k = 0; k < press_halvings; ++k) {
    const double share = k == 0 ? least_share : (kept + too_much) / 2;
    optim::DisplayDesign design = search(pressed_by(file, share * file.compression));
    const PanelLoads loads = panel_loads(file, panel, design.view, elasticity);
    if (!(share_of(file.limits, loads.hinges) <= HingeLimits::in_hand)) {
      too_much = share;
      if (k == 0) return;
      continue;
    }
    kept = share;
    display.design = std::move(design);
    display.loads = loads;
  }
}

}  // namespace kinetix::app
