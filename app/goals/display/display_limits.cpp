#include "app/goals/display/display_limits.hpp"

#include <cmath>

#include "app/goals/display/search_panel.hpp"
#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/exact_state.hpp"
#include "app/pipeline/hinge_loads.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/lattice_motion.hpp"

namespace kinetix::app {
namespace {

// Halvings in the search for the largest allowed compression: 2^-7 is below a hundredth of the requested compression.
constexpr int press_halvings = 7;
// Shares of the requested compression. The search starts at first_share, where most panels keep their limits. It tries
// no share below least_share, at which turns of hinges and differences of cells are a tenth of the full ones.
constexpr double first_share = 0.1, least_share = 0.01;
// Least difference of letter and rest, as a ratio to the mean of the rest. An eye distinguishes about 1 % (Weber's
// fraction).
constexpr double least_apart = 0.01;

}  // namespace

DisplayFile pressed_by(DisplayFile file, double share) {
  if (share == 1) return file;
  file.compression *= share;
  file.angle *= share;
  file.compression_range.reset();
  return file;
}

PanelLoads panel_loads(const DisplayFile& file, const model::Lattice& basic, optim::DisplayView view,
                       const model::Elasticity& elasticity) {
  view.plates.press = file.press;
  model::Lattice panel = basic;
  place_hinges(view, panel);
  const model::LinkageDrive drive = drive_on(panel, drive_of(view));
  const model::EquilibriumPath path =
      trace_equilibrium({panel, drive, exact_motion(panel)}, elasticity, path_of_run(true));
  PanelLoads loads;
  loads.hinges = hinge_loads(path, drive, panel, file.hinge);
  loads.compression = view.turn ? NAN : view.plates.compression;
  if (view.turn) loads.turn = view.turn->angle;
  const DisplayReading seen = read_panel(file, panel, path.state);
  loads.auc = seen.score.auc;
  loads.contrast = seen.score.contrast;
  loads.rank = seen.rank;
  loads.apart = std::abs(seen.score.separation()) / std::abs(seen.score.rest);
  loads.stretch = path.gaps.max;
  return loads;
}

void keep_limits(const DisplayFile& file, const model::Elasticity& elasticity, DisplayOutcome& display,
                 model::Lattice& panel, const std::function<optim::DisplayDesign(const DisplayFile&)>& search,
                 const std::stop_token& stop) {
  if (!file.limits.any()) return;
  display.loads = panel_loads(file, panel, display.design.view, elasticity);
  if (share_of(file.limits, display.loads->hinges) <= HingeLimits::in_hand) return;
  display.unlimited = display.loads;
  const auto keeps = [&](double share, double) -> std::optional<bool> {
    if (stop.stop_requested()) return std::nullopt;
    optim::DisplayDesign design = search(pressed_by(file, share));
    if (stop.stop_requested()) return std::nullopt;  // it may have been cut short
    const PanelLoads loads = panel_loads(file, panel, design.view, elasticity);
    if (!(share_of(file.limits, loads.hinges) <= HingeLimits::in_hand)) return false;
    if (!(loads.apart >= least_apart)) return true;
    display.design = std::move(design);
    display.loads = loads;
    display.pressed = share;
    return true;
  };
  const LimitRange found = halve({}, {press_halvings, 0, first_share, least_share}, keeps);
  if (display.pressed < 1) return;
  display.limits_stopped = stop.stop_requested();
  display.least_pressed = found.too_much;
  display.faint = found.kept > 0;
  display.unlimited.reset();
}

}  // namespace kinetix::app
