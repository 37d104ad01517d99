#include <fmt/format.h>

#include "app/display_json.hpp"
#include "app/equilibrium_summary.hpp"
#include "app/fold_json.hpp"
#include "app/helmet_json.hpp"
#include "app/result_json.hpp"

namespace kinetix {
namespace {

double degrees(double angle) { return angle / radians_per_degree; }

std::string line(const std::string& label, const std::string& text) {
  return fmt::format("  {:<10} {}\n", label, text);
}

double largest_tilt(const Structure& structure) {
  double largest = 0;
  for (const Hinge& hinge : structure.hinges) largest = std::max(largest, std::abs(hinge.parameters.beta));
  return largest;
}

std::string verdict(const Run& run) {
  if (run.curve->met) return "within tolerance";
  const bool close = run.curve->found.error.rms <= run.shape_tolerance;
  return close ? "WITHIN TOLERANCE, BUT WALLS COLLIDE" : "MISSES THE TOLERANCE";
}

std::string shape_lines(const Run& run) {
  const CurveOutcome& curve = *run.curve;
  const CurveError& error = curve.found.error;
  std::string text = line(
      "shape", fmt::format("rms {:.2e} of the goal's diagonal ({:.3f} mm), largest {:.3f} mm: {}", error.rms,
                           error.rms * error.scale_mm, error.max * error.scale_mm, verdict(run)));
  for (const std::string& reason : curve.why_missed) text += line("why", reason);
  const SolveResult& best = curve.found.search.runs[curve.found.chosen];
  text += line("search", fmt::format("{:.3f} s, {} from {} starts, {}", run.timings.optimise,
                                     to_string(curve.solver.name), curve.found.search.runs.size(),
                                     to_string(best.status)));
  return text;
}

/// The closed form passes through walls: says so where it did.
std::string contact_line(const Run& run) {
  if (!run.plan.free_range || run.curve || run.fold || run.helmet || run.equilibrium) return "";
  const ThetaLimit& limit = run.theta < 0 ? run.plan.free_range->negative : run.plan.free_range->positive;
  if (!limit.touches || std::abs(run.theta) <= std::abs(limit.theta)) return "";
  return line("WALLS",
              fmt::format("collide at theta {:.2f} deg, before this state; the closed form does not see it",
                          degrees(limit.theta)));
}

std::string physics_lines(const Run& run) {
  const Verification& v = *run.verification;
  if (v.physics.status != PhysicsResult::Status::settled)
    return line("physics", fmt::format("FAILED, {}: {}", to_string(v.physics.status), v.physics.why));
  if (!v.compared)
    return line("physics", fmt::format("settled in {:.2f} s; no model to compare with", v.physics.seconds));
  std::string text =
      line("physics",
           fmt::format("rms {:.1e} cell edges from the model, hinge gap {:.1e}, {:.2f} s: {}", v.distance.rms,
                       v.physics.gaps.max, v.physics.seconds, v.agrees ? "agrees" : "DISAGREES"));
  if (v.balance && !v.agrees) text += line("balance", v.balance->why);
  return text;
}

}  // namespace

std::string summary(const Run& run) {
  std::string text = fmt::format("{}: {} bodies, {} hinges\n", run.name, run.structure.bodies.size(),
                                 run.structure.hinges.size());
  text += line("plan", run.plan.family.why);
  text += line("fold", fmt::format("theta {:.2f} deg, tilts up to {:.2f} deg", degrees(run.theta),
                                   degrees(largest_tilt(run.structure))));
  text += contact_line(run);
  if (run.curve) text += shape_lines(run);
  if (run.display)
    for (const auto& [label, words] : display_lines(run)) text += line(label, words);
  if (run.fold)
    for (const auto& [label, words] : fold_lines(run)) text += line(label, words);
  if (run.helmet)
    for (const auto& [label, words] : helmet_lines(run)) text += line(label, words);
  if (run.equilibrium)
    for (const auto& [label, words] : equilibrium_lines(run)) text += line(label, words);
  if (run.verification) text += physics_lines(run);
  return text;
}

}  // namespace kinetix
