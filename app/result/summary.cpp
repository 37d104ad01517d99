#include <fmt/format.h>

#include <cmath>

#include "app/result/as_made_json.hpp"
#include "app/result/certified_json.hpp"
#include "app/result/equilibrium_summary.hpp"
#include "app/result/made_hinges.hpp"
#include "app/result/matter_json.hpp"
#include "app/result/result_json.hpp"
#include "app/result/robust_json.hpp"

namespace kinetix::app {
namespace {

std::string line(const std::string& label, const std::string& text) {
  return fmt::format("  {:<10} {}\n", label, text);
}

double largest_tilt(const model::Sheet& structure) {
  double largest = 0;
  for (int h = 0; h < structure.hinges(); ++h) largest = std::max(largest, std::abs(structure.hinge(h).beta));
  return largest;
}

/// The closed form passes through walls: says so where it did.
std::string contact_line(const Run& run) {
  if (!run.plan.free_range || run.goal || run.equilibrium) return "";
  const model::ThetaLimit& limit =
      run.theta < 0 ? run.plan.free_range->negative : run.plan.free_range->positive;
  if (!limit.touches || std::abs(run.theta) <= std::abs(limit.theta)) return "";
  return line("WALLS",
              fmt::format("collide at theta {:.2f} deg, before this state; the closed form ignores contact",
                          to_degrees(limit.theta)));
}

std::string physics_lines(const Run& run) {
  const Verification& v = *run.verification;
  if (v.physics.status != sim::PhysicsResult::Status::settled)
    return line("physics", fmt::format("FAILED, {}: {}", to_string(v.physics.status), v.physics.why));
  if (!v.compared)
    return line("physics", fmt::format("settled in {:.2f} s; no model to compare with", v.physics.seconds));
  std::string text =
      line("physics",
           fmt::format("rms {:.1e} cell edges from the model, hinge gap {:.1e}, {:.2f} s: {}", v.distance.rms,
                       v.physics.gaps.max, v.physics.seconds, v.agrees ? "agrees" : "DISAGREES"));
  if (v.equilibrium && !v.agrees) text += line("compared", v.equilibrium->why);
  return text;
}

}  // namespace

std::string summary(const Run& run) {
  std::string text =
      fmt::format("{}: {} bodies, {} hinges\n", run.name, run.structure.bodies(), run.structure.hinges());
  text += line("plan", run.plan.exact.why);
  if (run.plan.is_floppy())
    text += line("FLOPPY", fmt::format("it moves in {} independent ways; see `why` in result.json",
                                       run.plan.mobility->dofs_along));
  text += line("fold", fmt::format("theta {:.2f} deg, tilts up to {:.2f} deg", to_degrees(run.theta),
                                   to_degrees(largest_tilt(run.structure))));
  text += contact_line(run);
  if (run.certified)
    for (const auto& [label, words] :
         certified_lines(*run.certified, run.structure, run.theta, near_exact(run)))
      text += line(label, words);
  if (const auto worst = worst_strain(run))
    text += line("strained", fmt::format("by {:.3g} of {:g} that its material bears, the most of its hinges",
                                         worst->strain, worst->allowed));
  for (const auto& [label, words] : made_hinge_lines(run)) text += line(label, words);
  if (run.stopped)
    text += line("STOPPED", "before its end: this is the best so far, and only what was known of it");
  if (run.goal)
    for (const auto& [label, words] : run.goal->summary_lines(run)) text += line(label, words);
  for (const auto& [label, words] : matter_lines(run)) text += line(label, words);
  for (const auto& [label, words] : robust_lines(run)) text += line(label, words);
  for (const auto& [label, words] : as_made_lines(run)) text += line(label, words);
  if (run.equilibrium)
    for (const auto& [label, words] : equilibrium_lines(run)) text += line(label, words);
  if (run.verification) text += physics_lines(run);
  return text;
}

}  // namespace kinetix::app
