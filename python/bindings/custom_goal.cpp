#include "python/bindings/custom_goal.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/console/short_form.hpp"
#include "app/result/result_json.hpp"
#include "model/base/algorithms.hpp"

namespace kinetix::python {
namespace {

using Json = nlohmann::ordered_json;

// Estimated time per call of the error, s: what NumPy takes for a few operations. A start makes about a hundred calls.
constexpr double seconds_per_call = 2e-5, calls_per_start = 100;

struct CustomMeasure final : app::Measure {
  Eigen::VectorXd residuals;  ///< of the state, in units of the error
};

/// Outcome of the search for a user's goal.
struct CustomOutcome final : app::GoalOutcome {
  optim::SolverName solver = optim::SolverName::ceres;
  optim::MultiStartResult search;

  void add_sections(const app::Run& run, Json& result) const override {
    const Eigen::VectorXd& residuals = app::measure_of<CustomMeasure>(run).residuals;
    result["target"] = {{"kind", "own"}, {"name", run.design.name}};
    result["own"] = {{"residuals", std::vector<double>(residuals.begin(), residuals.end())},
                     {"reasons", run.violations},
                     {"reasons_physics", run.physics_violations()}};
    result["optimiser"] = app::search_json(search, search.best, solver);
  }
  void add_metrics(const app::Run& run, Json& metrics) const override {
    metrics["error"] = app::measure_of<CustomMeasure>(run).residuals.norm();
    metrics["met"] = run.met();
  }
  std::vector<app::SummaryLine> summary_lines(const app::Run& run) const override {
    const Eigen::VectorXd& residuals = app::measure_of<CustomMeasure>(run).residuals;
    return {{"error", fmt::format("{} (root of the sum of squares of {} numbers), limit {}",
                                  app::format_figures(residuals.norm()), residuals.size(),
                                  app::format_figures(app::tolerance_of(run, "error")))},
            app::search_line(run.timings.optimise, search, search.best, solver)};
  }
};

}  // namespace

CustomFit CustomGoal::fit() const {
  const double closing = closing_theta(size) - model::closing_margin;
  require(
      "theta[0]", allowed.theta.lower, allowed.theta.lower < closing,
      fmt::format("below {:.4g} rad, where walls of {:g} mm close the cells", closing, size.thickness_mm));
  starts.validate();
  CustomFit made(*error, make_bend_ties(allowed.columns, allowed.per, allowed.symmetry, allowed.beta),
                 allowed.rows, size.edge_mm, {allowed.theta.lower, std::min(allowed.theta.upper, closing)});
  Eigen::VectorXd r;
  error->at(made.state(made.start(0, 0)), r);
  error->throw_again();
  return made;
}

app::Forecast CustomGoal::forecast() const {
  app::Forecast out{sheet_of(model::ExactDesign<double>::basic(allowed.columns, allowed.rows), size)};
  out.search_s =
      seconds_per_call * calls_per_start * starts.starts * (error->has_gradient() ? 1 : allowed.columns);
  return out;
}

app::SearchResult CustomGoal::search(const app::RunOptions& options) const {
  options.progress("search", 0);
  CustomFit strip = fit();
  strip.end_when(options.stop);
  auto outcome = std::make_unique<CustomOutcome>();
  outcome->solver = starts.solver.name;
  outcome->search = multi_start(
      strip, [&](int k, std::uint64_t seed) { return strip.start(k, seed); },
      followed(starts, options, [](double least) { return fmt::format("least error {:.3g}", least); }));
  error->throw_again();
  const optim::SolveResult& best = outcome->search.best_run();
  if (!std::isfinite(best.residual_norm) && !options.stop.stop_requested())
    throw InvalidInput("the error has no finite value at any start of the search: " + best.why);
  const auto design = strip.design(best.x);
  app::SearchResult out;
  out.tolerances = {{"error", tolerance}};
  out.design.structure = sheet_of(design, size);
  out.theta = design.theta;
  out.goal = std::move(outcome);
  return out;
}

std::shared_ptr<const app::Measure> CustomGoal::measure(const app::Run& run, app::StateOf of,
                                                        const model::State& state,
                                                        const app::RunOptions&) const {
  auto out = std::make_shared<CustomMeasure>();
  const bool in_physics = of == app::StateOf::physics;
  const bool known = error->at(in_physics ? aligned(state, run.own) : state, out->residuals);
  error->throw_again();
  const double norm = known ? out->residuals.norm() : std::nan("");
  if (!(norm <= tolerance))
    out->violations.push_back(fmt::format("{}the error is {:.3g}; at most {:g} is allowed",
                                          in_physics ? "in the simulation " : "", norm, tolerance));
  if (in_physics) return out;
  model::append(collisions_during_motion(run, "use lower or thinner walls, or larger cells"),
                out->violations);
  return out;
}

}  // namespace kinetix::python
