#include "app/goals/display/legibility_front.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "app/goals/display/search_panel.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

// Cell edges, from half the thickness of a usual wall, which a film at its face gives, to what laps of the halves do.
constexpr double tried_offsets[] = {0.02, 0.05, 0.08, 0.12};
constexpr double same = 1e-9;  // cell edges

FrontPoint point_of(const DisplayFile& file, const model::Elasticity& elasticity,
                    const optim::DisplayOptions& options) {
  model::Sheet panel = make_panel(file, {file.goal.columns, file.goal.rows});
  optim::DisplayView view = search_panel(file, file.goal, panel, options, {}).view;
  view.plates.press = file.press;
  place_hinges(view, panel);
  model::EquilibriumPathOptions path_options;
  path_options.planar = true;
  const model::EquilibriumPath path =
      trace_equilibrium({panel, drive_on(panel, view), exact_motion(panel)}, elasticity, path_options);
  return front_point(file.offset, read_panel(file, panel, path.state), path);
}

}  // namespace

FrontPoint front_point(double offset, const DisplayReading& seen, const model::EquilibriumPath& path) {
  FrontPoint point;
  point.offset = offset;
  point.reached = path.stop == model::EquilibriumPath::Stop::reached;
  point.score = seen.score;
  point.rank = seen.rank;
  point.load = path.steps.back().load;
  point.stretch = path.gaps.max;
  return point;
}

std::vector<FrontPoint> legibility_front(const DisplayFile& file, const FrontPoint& own,
                                         const model::Elasticity& elasticity,
                                         const optim::DisplayOptions& options, const Progress& progress) {
  std::vector<FrontPoint> front = {own};
  front.back().is_own = true;
  // What the hinge can be made with; any where it is not said how it is made.
  const double most = file.hinge.made ? largest_offset_mm(*file.hinge.made, file.size) / file.size.edge_mm
                                      : std::numeric_limits<double>::infinity();
  for (const double offset : tried_offsets) {
    if (offset > most + same) continue;
    if (std::abs(offset - file.offset) <= same && !(file.strain > 0)) continue;
    if (options.solver.stop.stop_requested()) break;
    progress("other offsets", static_cast<double>(front.size() - 1) / std::size(tried_offsets));
    DisplayFile other = file;
    other.offset = offset;
    front.push_back(point_of(other, elasticity, options));
  }
  std::stable_sort(front.begin(), front.end(),
                   [](const FrontPoint& a, const FrontPoint& b) { return a.offset < b.offset; });
  return front;
}

}  // namespace kinetix::app
