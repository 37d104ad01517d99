#include <fmt/format.h>

#include <cmath>

#include "app/pipeline/body_pieces.hpp"
#include "app/result/as_made_json.hpp"
#include "app/result/certified_json.hpp"
#include "app/result/equilibrium_summary.hpp"
#include "app/result/made_hinges.hpp"
#include "app/result/matter_json.hpp"
#include "app/result/result_json.hpp"
#include "app/result/robust_json.hpp"
#include "app/result/verdict.hpp"

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

std::string physics_lines(const Run& run) {
  const Verification& v = *run.verification;
  if (v.physics.status != sim::PhysicsResult::Status::settled)
    return line("physics", fmt::format("FAILED, {}: {}", to_string(v.physics.status), v.physics.why));
  if (!v.compared)
    return line("physics", fmt::format("settled in {:.2f} s; no {} to compare with", v.physics.seconds,
                                       model_words(run)));
  std::string text =
      line("physics", fmt::format("rms {:.1e} cell edges from the {}, hinge gap {:.1e}, {:.2f} s: {}",
                                  v.distance.rms, model_words(run), v.physics.gaps.max, v.physics.seconds,
                                  v.agrees ? "agrees" : "DISAGREES"));
  if (v.equilibrium && !v.agrees) text += line("compared", v.equilibrium->why);
  return text;
}

std::string structure_lines(const Run& run) {
  const model::Sheet& structure = run.design.structure;
  if (run.way)
    return line("bodies", fmt::format("{}, {} hinges", structure.bodies(), structure.hinges())) +
           line(run.way->off ? "pull" : "closure", run.way->words);
  return line("sheet", fmt::format("{} bodies, {} hinges", structure.bodies(), structure.hinges())) +
         line("plan", run.plan.exact.why) +
         line("fold", fmt::format("theta {:.2f} deg, tilts up to {:.2f} deg", to_degrees(run.theta),
                                  to_degrees(largest_tilt(structure))));
}

}  // namespace

std::string summary(const Run& run) {
  const RunVerdict verdict = verdict_of(run);
  std::string text = fmt::format("{}: {}\n", run.design.name, headline(verdict));
  for (const auto& [label, words] : problem_lines(verdict)) text += line(label, words);
  text += structure_lines(run);
  if (run.certified)
    for (const auto& [label, words] :
         certified_lines(*run.certified, run.design.structure, run.theta, near_exact(run)))
      text += line(label, words);
  if (const auto worst = worst_strain(run))
    text += line("strained", fmt::format("by {:.3g} of {:g} that its material bears, the most of its hinges",
                                         worst->strain, worst->allowed));
  if (run.goal)
    for (const auto& [label, words] : run.goal->summary_lines(run)) text += line(label, words);
  for (const auto& [label, words] : matter_lines(run)) text += line(label, words);
  for (const auto& [label, words] : robust_lines(run)) text += line(label, words);
  for (const auto& [label, words] : as_made_lines(run)) text += line(label, words);
  if (run.equilibrium)
    for (const auto& [label, words] : equilibrium_lines(run)) text += line(label, words);
  if (run.verification) text += physics_lines(run);
  if (run.pieces)
    text += line("contact", fmt::format("{} convex pieces of the bodies, made in {:.2f} s",
                                        run.pieces->count(), run.pieces->seconds));
  return text;
}

}  // namespace kinetix::app
