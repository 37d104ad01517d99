#include "optim/display/display_search.hpp"

#include <random>

namespace kinetix::optim {
namespace {

using Eigen::VectorXd;
using Settling = DisplayProblem::Settling;

// Weight of (stretch over limit - 0.92)^2 against squared readings. At twice the limit it is about as much as
// an invisible picture costs at the usual separation of 0.16, (0.16 / 2)^2.
constexpr double stretch_weight_of_separation = 0.01;
// Weight of the same penalty against -2 log(contrast), and its factor per round. It starts low, since the
// picture has to lead.
constexpr double first_stretch_weight = 0.5, weight_growth = 20;
constexpr int max_rounds = 4;       // the last weighs stretch by 4000: more weight does not reduce it further
constexpr int starts_by_rule = 4;   // both choices of the checkerboard, at full and at half strength
constexpr double half = 0.5;        // of the full strength, which is rule_k's distance from 0.5
constexpr double max_shift = 0.08;  // of t, to either side: more would blur the picture of the rule

model::Plates along(model::Plates plates, model::Axis axis) {
  plates.axis = axis;
  return plates;
}

HingeTies ties_of(const model::Lattice& panel, const DisplayOptions& options) {
  return options.offset > 0 ? untied(panel.hinges()) : hinge_ties(*panel.squares(), options.symmetry);
}

/// Returns the fraction of the uniform-scaling cells in start k.
double rule_of_start(int k, double rule_k) {
  const double strength = k % starts_by_rule >= 2 && k < starts_by_rule ? half : 1;
  const double off = strength * (rule_k - 0.5);
  return 0.5 + (k % 2 == 0 ? off : -off);
}

/// Returns the cost of contrast of a view; less is clearer.
double haze(const DisplayView& view, const PictureCost& picture) {
  return picture.for_contrast(view.channel).cost;
}

bool is_better(const DisplayView& a, const DisplayView& b, const PictureCost& picture, double stretch) {
  const bool a_holds = a.stretch <= stretch, b_holds = b.stretch <= stretch;
  if (a_holds != b_holds) return a_holds;
  return a_holds ? haze(a, picture) < haze(b, picture) : a.stretch < b.stretch;
}

}  // namespace

DisplayView view_from_flat(PanelEquilibrium& equilibrium, const VectorXd& t, const VectorXd& offset,
                           const std::vector<double>& levels, Channel channel) {
  DisplayView view;
  view.t = t;
  view.offset = offset;
  view.plates = equilibrium.plates();
  equilibrium.forget();
  if (!equilibrium.settle(t, offset)) return view;
  view.at_equilibrium = true;
  view.state = equilibrium.state();
  view.channel = channel_values(channel, equilibrium.panel(), view.state);
  view.channel.resize(levels.size());
  view.score = targets::display_score(view.channel, levels);
  view.rank = targets::rank_correlation(view.channel, levels);
  view.stretch = hinge_gaps(equilibrium.panel(), view.state).max;
  return view;
}

int best_view(const std::vector<DisplayView>& views, const std::vector<double>& levels, double stretch) {
  const PictureCost picture(levels);
  int best = -1;
  for (int k = 0; k < static_cast<int>(views.size()); ++k)
    if (views[k].at_equilibrium && (best < 0 || is_better(views[k], views[best], picture, stretch))) best = k;
  return best;
}

DisplaySearch::DisplaySearch(const model::Lattice& panel, const std::vector<double>& levels,
                             const DisplayOptions& options, model::Axis axis)
    : levels_(levels),
      options_(options),
      picture_(levels),
      variables_{ties_of(panel, options), options.t, options.compression, options.offset},
      equilibrium_(panel, options.elasticity, along(options.plates, axis)) {}

VectorXd DisplaySearch::start(const DisplayView& view) const {
  return variables_.nearest(view.t, view.plates.compression, view.offset);
}

void DisplaySearch::stay_near(const VectorXd& x, double reach) {
  variables_.middle = x;
  variables_.reach = reach;
}

VectorXd DisplaySearch::start(int k) const {
  VectorXd t = variables_.ties.to_one_side(
      rule_display(*equilibrium_.panel().squares(), levels_, rule_of_start(k, options_.rule_k)));
  std::mt19937_64 random(options_.seed + static_cast<std::uint64_t>(k));
  std::uniform_real_distribution<double> shift(-max_shift, max_shift);
  if (k >= starts_by_rule)
    for (double& of_hinge : t) of_hinge += shift(random);
  return variables_.nearest(t, options_.plates.compression);
}

std::string DisplaySearch::name_of_start(int k) const {
  return "rule k = " + number_text(rule_of_start(k, options_.rule_k)) +
         (k < starts_by_rule ? "" : ", shifted at random") + ", plates along " +
         (equilibrium_.plates().axis == model::Axis::x ? "x" : "y");
}

DisplayView DisplaySearch::view(const VectorXd& x) {
  equilibrium_.press(variables_.compression_of(x).value_or(equilibrium_.plates().compression));
  return view_from_flat(equilibrium_, variables_.t_of(x), variables_.offset_of(x), levels_, options_.channel);
}

ScalarResult DisplaySearch::separate(const VectorXd& x) {
  const auto cost = [&](const std::vector<double>& readings) {
    return picture_.for_separation(readings, options_.separation);
  };
  DisplayProblem problem(equilibrium_, variables_, options_.channel, cost, options_.stretch,
                         stretch_weight_of_separation);
  return search(problem, x);
}

SharpenedDisplay DisplaySearch::sharpen(VectorXd x) {
  const auto cost = [&](const std::vector<double>& readings) { return picture_.for_contrast(readings); };
  SharpenedDisplay out;
  Settling settling = Settling::from_best;
  double weight = first_stretch_weight;
  for (int round = 0; round < max_rounds; ++round, weight *= weight_growth) {
    DisplayProblem problem(equilibrium_, variables_, options_.channel, cost, options_.stretch, weight,
                           settling);
    const ScalarResult found = search(problem, x);
    out.status = found.status;
    out.why = found.why;
    if (!std::isfinite(found.cost)) break;
    x = found.x;
    out.views.push_back(view(x));
    if (out.views.back().at_equilibrium && out.views.back().stretch <= options_.stretch) break;
    if (problem.stretch_of_best() <= options_.stretch) settling = Settling::from_flat;
  }
  return out;
}

ScalarResult DisplaySearch::search(DisplayProblem& problem, const VectorXd& x) {
  equilibrium_.forget();
  ScalarResult found = solve(problem, x, options_.solver);
  evaluations_ += found.evaluations;
  return found;
}

VectorXd rule_display(const model::Structure& panel, const std::vector<double>& levels, double k) {
  VectorXd highest = VectorXd::Zero(static_cast<Eigen::Index>(panel.hinges.size()));
  for (std::size_t c = 0; c < panel.cells.size(); ++c)
    for (const int h : panel.cell_members[c].hinges) highest[h] = std::max(highest[h], levels[c]);
  VectorXd t(highest.size());
  for (std::size_t h = 0; h < panel.hinges.size(); ++h) {
    const double of_class_a = 0.5 + (k - 0.5) * highest[h];
    t[h] = starts_in_sublattice_b(panel.hinges[h].wall) ? 1 - of_class_a : of_class_a;
  }
  return t;
}

}  // namespace kinetix::optim
