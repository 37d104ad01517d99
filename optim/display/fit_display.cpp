#include "optim/display/fit_display.hpp"

#include <fmt/format.h>
#include <exception>
#include <mutex>
#include <numeric>

#include "model/base/parallel_runs.hpp"
#include "model/lattice/lattice_motion.hpp"

namespace kinetix::optim {
namespace {

using Eigen::VectorXd;

constexpr int max_finalists = 2;  // starts of the second stage: each takes up to four searches more

/// Reports the share of the runs that are done.
class ProgressOfRuns {
 public:
  ProgressOfRuns(const Progress& progress, int runs) : progress_(progress), runs_(runs) {
    progress_("search", 0);
  }
  void one_more() {
    const std::lock_guard lock(mutex_);
    ++done_;
    progress_("search", static_cast<double>(done_) / runs_, fmt::format("run {} of {}", done_, runs_));
  }

 private:
  const Progress& progress_;
  std::mutex mutex_;
  int runs_, done_ = 0;
};

/// One start and its results.
struct Trail {
  Trail(model::Axis along, int number) : axis(along), start(number) {}

  model::Axis axis;
  int start;
  DisplayStart report;
  ScalarResult separated;
  SharpenedDisplay sharpened;
  int evaluations = 0, paths = 0;
};

class PanelSearch {
 public:
  PanelSearch(const model::Structure& panel, const std::vector<double>& levels, const DisplayOptions& options)
      : panel_(panel), levels_(levels), options_(options) {
    const std::vector<model::Axis> axes =
        options.axes.empty() ? std::vector{options.plates.axis} : options.axes;
    for (const model::Axis axis : axes)
      for (int k = 0; k < options.starts; ++k) trails_.emplace_back(axis, k);
  }

  DisplayDesign run(const Progress& progress) {
    const int count = static_cast<int>(trails_.size());
    ProgressOfRuns run_progress(progress, count + std::min(count, max_finalists));
    model::run_in_parallel(count, options_.threads, [&](int k) {
      separate(trails_[k]);
      run_progress.one_more();
    });
    const std::vector<int> chosen = finalists();
    model::run_in_parallel(static_cast<int>(chosen.size()), options_.threads, [&](int k) {
      sharpen(trails_[chosen[k]]);
      run_progress.one_more();
    });
    return design(chosen);
  }

 private:
  void separate(Trail& trail) const {
    DisplaySearch search(panel_, levels_, options_, trail.axis);
    const VectorXd x = search.start(trail.start);
    trail.report.name = search.name_of_start(trail.start);
    trail.report.view = search.view(x);
    trail.separated = search.separate(x);
    trail.report.cost = trail.separated.cost;
    trail.report.status = trail.separated.status;
    add_counts(search, trail);
  }

  void sharpen(Trail& trail) const {
    DisplaySearch search(panel_, levels_, options_, trail.axis);
    trail.report.sharpened = true;
    trail.sharpened = search.sharpen(trail.separated.x);
    trail.sharpened.views.push_back(search.view(trail.separated.x));
    add_counts(search, trail);
  }

  static void add_counts(const DisplaySearch& search, Trail& trail) {
    trail.evaluations += search.evaluations();
    trail.paths += search.paths_from_flat();
  }

  /// Returns the best of the first stage, without those that could not be evaluated.
  std::vector<int> finalists() const {
    std::vector<int> order(trails_.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [&](int k) { return !std::isfinite(trails_[k].separated.cost); });
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return trails_[a].separated.cost < trails_[b].separated.cost; });
    order.resize(std::min<std::size_t>(order.size(), max_finalists));
    return order;
  }

  DisplayDesign design(const std::vector<int>& chosen) {
    DisplayDesign out;
    choose_best(chosen, out);
    for (Trail& trail : trails_) {
      out.evaluations += trail.evaluations;
      out.paths_from_flat += trail.paths;
      out.starts.push_back(std::move(trail.report));
    }
    return out;
  }

  void choose_best(const std::vector<int>& chosen, DisplayDesign& out) const {
    std::vector<DisplayView> views;
    std::vector<int> from;
    for (const int k : chosen)
      for (const DisplayView& view : trails_[k].sharpened.views) {
        views.push_back(view);
        from.push_back(k);
      }
    const int best = best_view(views, levels_, options_.stretch);
    if (best < 0) {
      out.why = trails_.front().separated.why;
      return;
    }
    out.view = std::move(views[best]);
    out.status = trails_[from[best]].sharpened.status;
    out.why = trails_[from[best]].sharpened.why;
  }

  const model::Structure& panel_;
  const std::vector<double>& levels_;
  const DisplayOptions& options_;
  std::vector<Trail> trails_;
};

}  // namespace

DisplayView view_display(const model::Structure& panel, const std::vector<double>& levels,
                         const DisplayOptions& options) {
  PanelEquilibrium equilibrium(panel, options.elasticity, options.plates);
  VectorXd t(static_cast<Eigen::Index>(panel.hinges.size()));
  for (std::size_t h = 0; h < panel.hinges.size(); ++h) t[h] = panel.hinges[h].parameters.t;
  return view_from_flat(equilibrium, t, {}, levels, options.channel);
}

DisplayDesign fit_display(const model::Structure& panel, const std::vector<double>& levels,
                          const DisplayOptions& options, const Progress& progress) {
  return PanelSearch(panel, levels, options).run(progress);
}

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
  if (!s.clear) text += "; walls still collide during the motion";
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
      (design.refined ? "; then strained on purpose: " : "; strain on purpose made it no clearer: ") +
      sharpened.why;
  if (!design.refined) return;
  design.view = std::move(views[best]);
  design.status = sharpened.status;
}

}  // namespace kinetix::optim
