#include <cmath>
#include <string>
#include <utility>

#include "model/lattice/lattice_motion.hpp"
#include "optim/display/driven_hinge.hpp"
#include "optim/display/fit_display.hpp"

namespace kinetix::optim {
namespace {

// Largest change of the hinges from the state without strain, in fractions of a wall and cell edges. Hinges
// stretch by less than this. Panels with soft degrees of freedom find no equilibrium much further away.
constexpr double reaches[] = {0.04, 0.01};

DisplayView view_of(const model::Lattice& basic, const std::vector<double>& levels, Channel channel,
                    const ScaledDisplayOptions& options, const ScaledDisplay& scaled) {
  model::Lattice panel = basic;
  place_hinges(scaled.y, panel);
  DisplayView view;
  view.t.resize(panel.hinges());
  view.offset.resize(view.t.size());
  for (int h = 0; h < panel.hinges(); ++h) {
    view.t[h] = panel.hinge(h).t;
    view.offset[h] = panel.hinge(h).offset;
  }
  view.plates.axis = options.axis;
  view.plates.compression = scaled.compression;
  const model::PlanarStructure planar = planar_structure(panel);
  if (options.free_to)
    view.turn =
        turn_to(planar, options.hinge ? *options.hinge : middle_hinge(planar, scaled.y), scaled.theta);
  view.state = fold(planar, scaled.y, scaled.theta);
  view.channel = channel_values(channel, panel, view.state);
  view.channel.resize(levels.size());
  view.score = targets::display_score(view.channel, levels);
  view.rank = targets::rank_correlation(view.channel, levels);
  view.stretch = hinge_gaps(panel, view.state).max;
  view.at_equilibrium = true;
  return view;
}

std::string words(const ScaledDisplay& s) {
  std::string text = "scales of walls, a convex problem: " +
                     std::string(s.converged ? "optimal" : "not converged after many iterations");
  if (s.rounds > 1)
    text += "; " + std::to_string(s.rounds) + " rounds, each with less turning, so that walls stay apart";
  if (!s.clear) text += "; walls meet on the way all the same";
  return text;
}

}  // namespace

DisplayDesign fit_scaled_display(const model::Lattice& panel, const std::vector<double>& levels,
                                 Channel channel, const std::vector<model::Axis>& axes,
                                 const ScaledDisplayOptions& options) {
  const PictureCost picture(levels);
  DisplayDesign best;
  double least = std::numeric_limits<double>::infinity();
  for (const model::Axis axis : axes) {
    ScaledDisplayOptions along = options;
    along.axis = axis;
    ScaledDisplay scaled = scale_display(planar_structure(panel), levels, along);
    DisplayView view = view_of(panel, levels, channel, along, scaled);
    best.evaluations += scaled.iterations;
    const double haze = picture.for_contrast(view.channel).cost;
    if (best.scaled && !(haze < least)) continue;
    least = haze;
    best.view = std::move(view);
    best.status = scaled.converged ? SolveStatus::converged : SolveStatus::evaluation_limit;
    best.why = words(scaled);
    best.scaled = std::move(scaled);
  }
  return best;
}

void refine_display(const model::Lattice& panel, const std::vector<double>& levels,
                    const DisplayOptions& options, DisplayDesign& design) {
  DisplayOptions along = options;
  along.plates = design.view.plates;
  DisplaySearch search(panel, levels, along, along.plates.axis);
  const Eigen::VectorXd start = search.start(design.view);
  std::vector<DisplayView> views = {search.view(start)};
  SharpenedDisplay sharpened;
  int best = 0;
  for (const double reach : reaches) {
    search.stay_near(start, reach);
    sharpened = search.sharpen(start);
    for (DisplayView& view : sharpened.views) views.push_back(std::move(view));
    best = best_view(views, levels, options.stretch);
    if (best > 0) break;
  }
  design.evaluations += search.evaluations();
  design.refined = best > 0;
  design.why +=
      (design.refined ? "; then strained on purpose: " : "; strained on purpose it came out no clearer: ") +
      sharpened.why;
  if (!design.refined) return;
  design.view = std::move(views[best]);
  design.status = sharpened.status;
}

}  // namespace kinetix::optim
