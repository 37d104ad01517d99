#include "optim/fit_display.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

using Eigen::VectorXd;

constexpr double stretch_weight_of_separation = 0.5;
constexpr double stretch_weight_of_contrast = 20;

DisplayView read(const PanelBalance& balance, const std::vector<double>& levels, Channel channel) {
  DisplayView view;
  view.balanced = true;
  view.state = balance.state();
  view.channel = channel_values(channel, balance.panel(), view.state);
  view.score = display_score(view.channel, levels);
  view.rank = rank_correlation(view.channel, levels);
  view.stretch = hinge_gaps(balance.panel(), view.state).max;
  return view;
}

DisplayView view_from_flat(PanelBalance& balance, const VectorXd& t, const std::vector<double>& levels,
                           Channel channel) {
  balance.forget();
  DisplayView view;
  if (balance.settle(t)) view = read(balance, levels, channel);
  view.t = t;
  return view;
}

class Search {
 public:
  Search(const Structure& panel, const std::vector<double>& levels, const DisplayOptions& options)
      : levels_(levels),
        options_(options),
        picture_(levels),
        ties_(hinge_ties(panel, options.symmetry)),
        balance_(panel, options.elasticity, options.plates) {}

  DisplayDesign run(const std::function<void(const std::string&, double)>& progress) {
    const auto tell = [&](const std::string& stage, double done) {
      if (progress) progress(stage, done);
    };
    ScalarResult best;
    best.cost = std::numeric_limits<double>::infinity();
    tell("search", 0);
    for (const double k : {options_.rule_k, 1 - options_.rule_k}) {
      ScalarResult found = separate(k);
      tell("search", k < 0.5 ? 0.3 : 0.6);
      if (found.cost < best.cost) best = std::move(found);
    }
    if (std::isfinite(best.cost)) best = sharpen(best);
    tell("search", 1);
    design_.status = best.status;
    design_.why = best.why;
    if (std::isfinite(best.cost))
      design_.view = view_from_flat(balance_, ties_.expand(best.x), levels_, options_.channel);
    design_.paths_from_flat = balance_.paths_from_flat();
    return std::move(design_);
  }

 private:
  ScalarResult separate(double k) {
    DisplayStart start;
    start.name = "rule k = " + number_text(k);
    const VectorXd x = within(ties_.nearest(rule_display(balance_.panel(), levels_, k)));
    start.view = view_from_flat(balance_, ties_.expand(x), levels_, options_.channel);
    const auto cost = [&](const std::vector<double>& readings) {
      return picture_.for_separation(readings, options_.separation);
    };
    ScalarResult found = search(x, cost, stretch_weight_of_separation);
    start.cost = found.cost;
    start.status = found.status;
    design_.starts.push_back(std::move(start));
    return found;
  }

  ScalarResult sharpen(const ScalarResult& from) {
    const auto cost = [&](const std::vector<double>& readings) { return picture_.for_contrast(readings); };
    balance_.forget();
    ScalarResult found = search(from.x, cost, stretch_weight_of_contrast);
    return std::isfinite(found.cost) ? found : from;
  }

  ScalarResult search(const VectorXd& x, DisplayProblem::Cost cost, double stretch_weight) {
    DisplayProblem problem(balance_, ties_, options_.channel, std::move(cost), options_.t, options_.stretch,
                           stretch_weight);
    ScalarResult found = solve(problem, x, options_.solver);
    design_.evaluations += found.evaluations;
    return found;
  }

  VectorXd within(const VectorXd& x) const { return x.cwiseMax(options_.t[0]).cwiseMin(options_.t[1]); }

  const std::vector<double>& levels_;
  const DisplayOptions& options_;
  PictureCost picture_;
  HingeTies ties_;
  PanelBalance balance_;
  DisplayDesign design_;
};

}  // namespace

DisplayView view_display(const Structure& panel, const std::vector<double>& levels,
                         const DisplayOptions& options) {
  PanelBalance balance(panel, options.elasticity, options.plates);
  VectorXd t(static_cast<Eigen::Index>(panel.hinges.size()));
  for (std::size_t h = 0; h < panel.hinges.size(); ++h) t[h] = panel.hinges[h].parameters.t;
  return view_from_flat(balance, t, levels, options.channel);
}

VectorXd rule_display(const Structure& panel, const std::vector<double>& levels, double k) {
  VectorXd highest = VectorXd::Zero(static_cast<Eigen::Index>(panel.hinges.size()));
  for (std::size_t c = 0; c < panel.cells.size(); ++c)
    for (const int h : panel.cell_members[c].hinges) highest[h] = std::max(highest[h], levels[c]);
  VectorXd t(highest.size());
  for (std::size_t h = 0; h < panel.hinges.size(); ++h) {
    const double of_class_a = 0.5 + (k - 0.5) * highest[h];
    t[h] = panel.hinges[h].wall.from.is_class_a() ? of_class_a : 1 - of_class_a;
  }
  return t;
}

DisplayDesign fit_display(const Structure& panel, const std::vector<double>& levels,
                          const DisplayOptions& options,
                          const std::function<void(const std::string&, double)>& progress) {
  return Search(panel, levels, options).run(progress);
}

}  // namespace kinetix
