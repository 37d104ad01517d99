#include "app/goals/display/legibility_front.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "app/goals/display/search_panel.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/sheet/sheet_motion.hpp"
#include "targets/display/panel_levels.hpp"

namespace kinetix::app {
namespace {

// Cell edges, from half the thickness of a usual wall, which a film at its face gives, to what laps of the halves do.
constexpr double tried[] = {0.02, 0.05, 0.08, 0.12};
constexpr double same = 1e-9;  // cell edges

FrontPoint point_of(const DisplayFile& file, const model::Elasticity& elasticity,
                    const optim::DisplayOptions& options) {
  model::Sheet panel = make_panel(file, {file.goal.columns, file.goal.rows});
  const optim::DisplayView view = search_panel(file, file.goal, panel, options, {}).view;
  place_hinges(view, panel);
  const model::LinkageDrive drive = drive_on(
      panel,
      {.axis = view.plates.axis, .compression = view.plates.compression, .branch = view.plates.branch});
  model::EquilibriumPathOptions path_options;
  path_options.planar = true;
  const model::EquilibriumPath path =
      trace_equilibrium({panel, drive, exact_motion(panel)}, elasticity, path_options);
  const std::vector<double> levels = levels_of(file.goal, panel);
  std::vector<double> channel = channel_values(file.channel, panel, path.state);
  channel.resize(levels.size());
  FrontPoint point;
  point.offset = file.offset;
  point.reached = path.stop == model::EquilibriumPath::Stop::reached;
  point.score = targets::display_score(channel, levels);
  point.rank = targets::rank_correlation(channel, levels);
  point.load = path.steps.back().load;
  point.stretch = path.gaps.max;
  return point;
}

}  // namespace

std::vector<FrontPoint> legibility_front(const DisplayFile& file, const model::Elasticity& elasticity,
                                         const optim::DisplayOptions& options,
                                         const std::function<void(const std::string&, double)>& progress) {
  std::set<double> offsets = {file.offset};
  for (const double offset : tried)
    if (std::abs(offset - file.offset) > same) offsets.insert(offset);
  std::vector<FrontPoint> front;
  for (const double offset : offsets) {
    if (progress)
      progress("other offsets", static_cast<double>(front.size()) / static_cast<double>(offsets.size()));
    DisplayFile other = file;
    other.offset = offset;
    front.push_back(point_of(other, elasticity, options));
    front.back().is_own = offset == file.offset;
  }
  return front;
}

}  // namespace kinetix::app
