#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/assembly/assembly_run.hpp"
#include "app/pipeline/verify.hpp"
#include "app/run/drive_end.hpp"

namespace kinetix::app {
namespace {

// Part of the way to the poses: rounding of files lets bodies move by up to 3 % of it, mechanisms by all of it.
constexpr double least_way = 0.05;

std::string kinds_of(const model::Assembly& assembly) {
  std::set<std::string> kinds;
  for (const model::AssemblyHinge& h : assembly.hinges) kinds.insert(h.ball ? "ball" : to_string(h.kind));
  return fmt::format("{}", fmt::join(kinds, ", "));
}

/// Largest distance of a body from its place at rest, as Deployment::off_max measures it, cell edges.
double way_of(const AssemblyRun& run) {
  const model::State &rest = run.motion.states.front(), &last = run.motion.states.back();
  double most = 0;
  for (std::size_t b = 0; b < last.size(); ++b)
    most = std::max(most, (last[b].p - rest[b].p).norm() / run.linkage.size.edge_mm +
                              0.5 * (last[b].R - rest[b].R).norm());
  return most;
}

/// Reasons why the bodies do not reach the poses that they are pulled to.
std::vector<std::string> pull_reasons(const AssemblyRun& run) {
  const double allowed = run.file.pull_tolerance;
  const model::Deployment& pull = *run.deployment;
  if (pull.off_rms <= allowed) return {};
  const double way = way_of(run);
  if (way <= least_way * pull.off_rms)
    return {
        fmt::format("rest and target are two states of their own, not a mechanism between them: bodies move "
                    "by {:.2g} cell edges at most, and end {:.3g} (rms) from the target; {:g} are allowed",
                    way, pull.off_rms, allowed)};
  return {fmt::format("bodies end {:.3g} cell edges (rms) from where they are pulled to; {:g} are allowed",
                      pull.off_rms, allowed)};
}

std::vector<std::string> drive_reasons(const AssemblyRun& run) {
  if (run.model == Model::equilibrium) {
    if (run.equilibrium->stop == model::EquilibriumPath::Stop::reached) return {};
    return {drive_stop_reason(*run.equilibrium)};
  }
  if (!run.motion.reached) return {closure_words(run)};
  if (run.file.poses) return pull_reasons(run);
  if (run.file.expand && way_of(run) <= least_way * run.deployment->off_rms)
    return {"no body moves: the hinges hold the bodies where they are"};
  return {};
}

std::vector<std::string> agreement_reasons(const AssemblyRun& run) {
  const Verification& v = *run.verification;
  if (v.agrees) return {};
  if (!is_settled(v)) return {failed_simulation_reason(v)};
  return {fmt::format("the simulation ends {:.3g} cell edges (rms) from the closed state; {:g} are allowed",
                      v.distance.rms, GoalSettings::usual_verify)};
}

}  // namespace

RunVerdict verdict_of(const AssemblyRun& run) {
  RunVerdict out;
  const std::string hinges = kinds_of(run.file.assembly);
  const std::vector<std::string> drive = drive_reasons(run);
  if (run.file.poses) out.set(&RunVerdict::met, drive, hinges);
  if (run.verification) out.set(&RunVerdict::agrees, agreement_reasons(run), hinges);
  out.set(&RunVerdict::reaches, drive, hinges);
  return out;
}

}  // namespace kinetix::app
