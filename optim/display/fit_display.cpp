#include "optim/display/fit_display.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <numeric>

#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"

namespace kinetix::optim {
namespace {

using Eigen::VectorXd;

constexpr int most_finalists = 2;  // starts of the second stage: each takes up to four searches more

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
  DisplayStart told;
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
    ProgressOfRuns told(progress, count + std::min(count, most_finalists));
    model::run_in_parallel(count, options_.threads, [&](int k) {
      separate(trails_[k]);
      told.one_more();
    });
    const std::vector<int> chosen = finalists();
    model::run_in_parallel(static_cast<int>(chosen.size()), options_.threads, [&](int k) {
      sharpen(trails_[chosen[k]]);
      told.one_more();
    });
    return design(chosen);
  }

 private:
  void separate(Trail& trail) const {
    DisplaySearch search(panel_, levels_, options_, trail.axis);
    const VectorXd x = search.start(trail.start);
    trail.told.name = search.name_of_start(trail.start);
    trail.told.view = search.view(x);
    trail.separated = search.separate(x);
    trail.told.cost = trail.separated.cost;
    trail.told.status = trail.separated.status;
    add_counts(search, trail);
  }

  void sharpen(Trail& trail) const {
    DisplaySearch search(panel_, levels_, options_, trail.axis);
    trail.told.sharpened = true;
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
    order.resize(std::min<std::size_t>(order.size(), most_finalists));
    return order;
  }

  DisplayDesign design(const std::vector<int>& chosen) {
    DisplayDesign out;
    take_best(chosen, out);
    for (Trail& trail : trails_) {
      out.evaluations += trail.evaluations;
      out.paths_from_flat += trail.paths;
      out.starts.push_back(std::move(trail.told));
    }
    return out;
  }

  void take_best(const std::vector<int>& chosen, DisplayDesign& out) const {
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

}  // namespace kinetix::optim
