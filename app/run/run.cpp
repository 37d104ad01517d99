#include "app/run/run.hpp"

#include <array>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

/// Returns the requested theta, rad, which the equilibrium need not have reached. Plates on lattices other than
/// squares need not approach each other by the cosine of theta. Files have no drive for such lattices.
double asked_theta(const Run& run) {
  if (!run.equilibrium) return run.theta;
  const model::LinkageDrive& drive = run.equilibrium->drive;
  const bool is_by_cosine = run.design.drive || run.design.structure.squares() || !drive.has_plates();
  if (is_by_cosine || !run.plan.exact) return drive.theta();
  try {
    return run.plan.exact.theta_of(drive);
  } catch (const InvalidInput&) {
    return drive.theta();
  }
}

}  // namespace

std::string in_words(StateOf of) {
  constexpr std::array words = {"model", "equilibrium", "physics run"};
  return words[static_cast<std::size_t>(of)];
}

Design asked_design(const Found& found) {
  Design design = found.design;
  design.theta = found.theta;
  return design;
}

Found planned(Found found, bool brief) {
  if (found.goal)
    found.design.hinge_overrides = hinge_overrides_of(found.design.structure, found.hinge_parts);
  found.plan =
      (brief ? make_brief_plan : make_plan)(found.design.structure, found.model, std::move(found.plan.exact));
  if (!found.goal || found.plan.model == Model::equilibrium) return found;
  if (!found.plan.exact)
    throw InvalidInput("the design that was found has no exact motion: " + found.plan.exact.why);
  found.own = found.motion ? found.motion(found.theta) : found.plan.exact.at(found.theta);
  return found;
}

const char* tolerance_words(const Run& run, bool is_within) {
  if (run.met()) return "within tolerance";
  if (run.strained) return "WITHIN TOLERANCE, BUT HINGES ARE STRAINED TOO FAR";
  return is_within ? "WITHIN TOLERANCE, BUT NOT AS REQUIRED" : "MISSES THE TOLERANCE";
}

Design written_design(const Run& run) {
  Design design = run.design;
  design.theta = asked_theta(run);
  return design;
}

}  // namespace kinetix::app
