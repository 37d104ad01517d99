#include "app/print/sheet/print_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/pipeline/design_drive.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "app/print/sheet/fold_motion.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/sheet/sheet_motion.hpp"
#include "model/sheet/turn_laws.hpp"

namespace kinetix::app {
namespace {

constexpr double told_mm = 0.01;    // mm: no printer tells folds apart that are nearer
constexpr double known_mm = 0.005;  // mm: to which a path is to be known between its states
constexpr int most_rounds = 3;      // of halving the steps of a path that is not

PrintPath exact_path(const Design& design, const model::ExactMotion& exact, PrintPath path) {
  const double theta = exact_theta_of(design, exact);
  if (theta == 0) {
    path.why_flat_alone = "the design's theta is 0";
    return path;
  }
  for (int k = 1; k <= path_steps; ++k) {
    path.thetas.push_back(theta * k / path_steps);
    path.states.push_back(exact.at(path.thetas.back()));
  }
  path.turns = turn_laws(design.structure);
  path.motion = [at = exact.at, edge = design.structure.size().edge_mm](double there) {
    return with_edge({at(there)}, 1 / edge).front();
  };
  return path;
}

model::EquilibriumPathOptions steps_of(const Design& design, int steps) {
  model::EquilibriumPathOptions options;
  options.side = design.side;
  options.longest_step = std::clamp(std::abs(design.theta) / steps, options.least_step, options.longest_step);
  options.first_step = std::min(options.first_step, options.longest_step);
  options.longest_step_touching = std::min(options.longest_step_touching, options.longest_step);
  return options;
}

/// The states that a path comes to just after a snap, less one.
std::vector<int> jumps_of(const model::EquilibriumPath& traced, const std::vector<double>& thetas) {
  std::vector<int> out;
  for (const model::PathEvent& event : traced.events) {
    if (event.kind != model::PathEvent::Kind::snap) continue;
    const auto at = std::find(thetas.begin(), thetas.end(), event.at.theta);
    if (at != thetas.end() && at != thetas.begin()) out.push_back(static_cast<int>(at - thetas.begin()) - 1);
  }
  return out;
}

/// At steps as even as the path allows.
PrintPath traced_path(const Design& design, const model::ExactMotion& exact, int steps, PrintPath path) {
  const model::EquilibriumPath traced = trace_equilibrium(
      {design.structure, drive_of(design), exact}, elasticity_of(design), steps_of(design, steps),
      [&](const model::EquilibriumStep& step, const model::State& state) {
        if (step.theta == path.thetas.back()) return;
        path.thetas.push_back(step.theta);
        path.states.push_back(state);
      });
  path.is_exact = false;
  path.jumps = jumps_of(traced, path.thetas);
  if (traced.stop == model::EquilibriumPath::Stop::reached) return path;
  path.thetas.resize(1);
  path.states.resize(1);
  path.jumps.clear();
  path.why_flat_alone = exact.why + "; and its equilibrium does not get there: " + traced.why;
  return path;
}

PrintPath equilibrium_path(const Design& design, const model::ExactMotion& exact, const PrintPath& flat) {
  int steps = path_steps;
  PrintPath path = traced_path(design, exact, steps, flat);
  for (int round = 0; round < most_rounds && sampling_error_mm(path, design.structure) > known_mm; ++round) {
    PrintPath finer = traced_path(design, exact, steps *= 2, flat);
    if (finer.states.size() <= path.states.size()) break;
    path = std::move(finer);
  }
  return path;
}

}  // namespace

PrintPath print_path(const Design& design) {
  const model::Linkage linkage = design.structure;
  const model::ExactMotion exact = exact_motion(design.structure);
  PrintPath path{{0}, {rest_state(linkage)}};
  path = exact ? exact_path(design, exact, std::move(path)) : equilibrium_path(design, exact, path);
  path.states = with_edge(std::move(path.states), 1 / design.structure.size().edge_mm);
  return path;
}

std::optional<std::string> equilibrium_beside_exact(const Design& design, double edge_mm) {
  const model::ExactMotion exact = exact_motion(design.structure);
  if (!exact || design.hinge.model != HingeSection::Model::elastic) return std::nullopt;
  model::EquilibriumPathOptions options;
  options.side = design.side;
  const model::EquilibriumPath traced =
      trace_equilibrium({design.structure, drive_of(design), exact}, elasticity_of(design), options);
  const std::string start = "folded along its exact motion: the equilibrium of its elastic hinges ";
  if (traced.stop != model::EquilibriumPath::Stop::reached)
    return start + "does not get there: " + traced.why;
  const model::State fold = exact.at(exact_theta_of(design, exact));
  const double away_mm = edge_mm * aligned_distance(design.structure, traced.state, fold).max;
  if (away_mm < told_mm) return std::nullopt;
  return start + fmt::format("under its drive is up to {:.3g} mm from that", away_mm);
}

std::vector<model::State> with_edge(std::vector<model::State> states, double edge_mm) {
  for (model::State& state : states)
    for (model::Pose& pose : state) pose.p *= edge_mm;
  return states;
}

}  // namespace kinetix::app
