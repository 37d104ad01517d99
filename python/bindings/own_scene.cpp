#include "python/bindings/own_scene.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/result/search_json.hpp"
#include "model/base/invalid_input.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::python {
namespace {

using Json = nlohmann::ordered_json;

constexpr double below_closing = 0.1 * radians_per_degree;  // rad that theta keeps from where cells close
// s a call of the error, of which a start makes some hundred: what NumPy takes for a few operations.
constexpr double seconds_a_call = 2e-5, calls_a_start = 100;

std::string missing(double norm, double tolerance, const char* of) {
  return fmt::format("{}the error is {:.3g}; at most {:g} is allowed", of, norm, tolerance);
}

/// The search with its progress; what Python raised is thrown.
optim::MultiStartResult searched(const OwnGoal& goal, const OwnFit& fit, const app::RunOptions& options) {
  optim::MultiStartOptions search = goal.search;
  search.threads = options.threads;
  search.seed = options.seed;
  search.solver.stop = options.stop;
  search.ended = [&](int ended, double least) {
    options.progress("search", static_cast<double>(ended) / search.starts,
                     fmt::format("start {} of {}, least error {:.3g}", ended, search.starts, least));
  };
  auto found = multi_start(
      fit, [&](int k, std::uint64_t seed) { return fit.start(k, seed); }, search);
  goal.error->raise_again();
  if (!std::isfinite(found.best_run().residual_norm) && !options.stop.stop_requested())
    throw InvalidInput("the error has no finite value at any start of the search: " + found.best_run().why);
  return found;
}

class OwnScene final : public app::Scene {
 public:
  explicit OwnScene(OwnGoal goal) : Scene(goal.name), goal_(std::move(goal)) {}

  app::Forecast forecast() const override {
    app::Forecast out{sheet_of(model::ExactDesign<double>::basic(goal_.columns, goal_.rows), goal_.size)};
    out.search_s = seconds_a_call * calls_a_start * goal_.search.starts *
                   (goal_.error->has_gradient() ? 1 : goal_.columns);
    return out;
  }

  app::Found search(const app::RunOptions& options) const override {
    options.progress("search", 0);
    OwnFit fit = goal_.fit();
    fit.end_when(options.stop);
    auto outcome = std::make_unique<OwnOutcome>();
    outcome->name = goal_.name;
    outcome->tolerance = goal_.tolerance;
    outcome->solver = goal_.search.solver.name;
    outcome->search = searched(goal_, fit, options);
    const auto design = fit.design(outcome->search.best_run().x);
    app::Found out;
    out.tolerances = {{"error", goal_.tolerance}};
    out.design.structure = sheet_of(design, goal_.size);
    out.theta = design.theta;
    out.goal = std::move(outcome);
    return out;
  }

  /// Of the model's state and of where the physics run ended, laid over that.
  std::shared_ptr<const app::Measure> measure(const app::Run& run, app::StateOf of, const model::State& state,
                                              const app::RunOptions&) const override {
    auto out = std::make_shared<OwnMeasure>();
    const bool in_physics = of == app::StateOf::physics;
    const double norm = norm_of(in_physics ? aligned(state, run.own) : state, out->residuals);
    if (!(norm <= goal_.tolerance))
      out->violations.push_back(missing(norm, goal_.tolerance, in_physics ? "in the physics run " : ""));
    if (in_physics) return out;
    model::ThetaRangeOptions until;
    until.limit = run.theta;
    const auto touch = theta_range(run.design.structure, run.plan.exact, until).positive;
    if (touch.touches)
      out->violations.push_back(
          fmt::format("walls run into each other at theta {:.2f} deg, before the {:.2f} deg of the goal: use "
                      "lower or thinner walls, "
                      "or larger cells",
                      to_degrees(touch.theta), to_degrees(run.theta)));
    return out;
  }

 private:
  /// Not a number where the error is none. @throws what Python raised
  double norm_of(const model::State& state, Eigen::VectorXd& residuals) const {
    const bool known = goal_.error->at(state, residuals);
    goal_.error->raise_again();
    return known ? residuals.norm() : std::numeric_limits<double>::quiet_NaN();
  }

  OwnGoal goal_;
};

}  // namespace

OwnFit OwnGoal::fit() const {
  require("tolerance", tolerance, tolerance >= 0 && std::isfinite(tolerance), "0 or more, and finite");
  require("columns", columns, columns >= 2 && columns <= 10000, "2 to 10000");
  require("rows", rows, rows >= 1 && rows <= 10000, "1 to 10000");
  require("theta[0]", theta.lower, theta.lower > 0 && theta.lower < theta.upper,
          "above 0 and below theta[1], rad");
  require("theta[1]", theta.upper, theta.upper < pi / 2, "below pi/2 rad");
  require("beta[0]", beta.lower, beta.lower > -pi / 2 && beta.lower < beta.upper,
          "above -pi/2 and below beta[1], rad");
  require("beta[1]", beta.upper, beta.upper < pi / 2, "below pi/2 rad");
  const double closing = closing_theta(size) - below_closing;
  require(
      "theta[0]", theta.lower, theta.lower < closing,
      fmt::format("below {:.4g} rad, where walls of {:g} mm close the cells", closing, size.thickness_mm));
  search.validate();
  OwnFit made(*error, make_bend_ties(columns, per, symmetry, beta), rows, size.edge_mm,
              {theta.lower, std::min(theta.upper, closing)});
  Eigen::VectorXd r;
  error->at(made.state(made.start(0, 0)), r);
  error->raise_again();
  return made;
}

void OwnOutcome::add_sections(const app::Run& run, Json& result) const {
  result["target"] = {{"kind", "own"}, {"name", name}};
  const Eigen::VectorXd& residuals = app::measure_of<OwnMeasure>(run).residuals;
  result["own"] = {{"residuals", std::vector<double>(residuals.begin(), residuals.end())},
                   {"reasons", run.violations},
                   {"reasons_physics", run.physics_violations()}};
  result["optimiser"] = app::search_json(search, search.best, solver);
}

void OwnOutcome::add_metrics(const app::Run& run, Json& metrics) const {
  metrics["error"] = app::measure_of<OwnMeasure>(run).residuals.norm();
  metrics["met"] = run.met();
}

std::vector<app::SummaryLine> OwnOutcome::summary_lines(const app::Run& run) const {
  const Eigen::VectorXd& residuals = app::measure_of<OwnMeasure>(run).residuals;
  std::vector<app::SummaryLine> lines;
  lines.push_back(
      {"error", fmt::format("{:.3g} of {} numbers (root of the sum of squares): {}", residuals.norm(),
                            residuals.size(), run.met() ? "within tolerance" : "MISSES THE TOLERANCE")});
  lines.push_back(
      {"search", fmt::format("{:.3f} s, {} from {} starts, {}", run.timings.optimise, to_string(solver),
                             search.runs.size(), to_string(search.best_run().status))});
  return lines;
}

std::unique_ptr<app::Scene> make_scene(OwnGoal goal) { return std::make_unique<OwnScene>(std::move(goal)); }

}  // namespace kinetix::python
