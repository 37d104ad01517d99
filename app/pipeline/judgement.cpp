#include "app/pipeline/judgement.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/pipeline/as_made.hpp"
#include "app/pipeline/certify.hpp"
#include "app/run/stopwatch.hpp"

namespace kinetix::app {
namespace {

void judge_prints(const Run& run, const Scene& scene, const RunOptions& options, Judgement& out) {
  if (!run.goal || run.states.empty() || options.stop.stop_requested()) return;
  if (run.matter && !run.equilibrium) {
    out.prints_unknown = "elastic hinges find no equilibrium near the design: " + run.matter->why;
    return;
  }
  const model::State state = run.matter ? run.equilibrium->path.state : scene.own_state(run);
  const auto judged = scene.judged(run, run.structure, run.theta, state);
  if (!judged) return;
  options.progress("prints", -1);
  out.printed = as_made(run, run.matter ? run.equilibrium->drive : drive_to(run.structure, run.theta), state,
                        judged->points, options);
  if (out.printed)
    out.printed->tolerance_mm = judged->tolerance_mm;
  else
    out.prints_unknown = "elastic hinges have no stable state near the design under its drive";
}

void prove_range(const Run& run, const RunOptions& options, Judgement& out) {
  if (!options.certify || options.stop.stop_requested()) return;
  options.progress("contact", -1);
  out.certified = certify(run.structure, run.plan, run.process.sd, options.threads);
}

/// Puts right one end of a range whose samples have missed walls that touch before.
void correct(model::ThetaLimit& sampled, const model::CertifiedLimit& proven, Plan& plan) {
  if (!proven.contact || std::abs(sampled.theta) <= std::abs(*proven.contact)) return;
  plan.why.push_back(fmt::format("walls touch at theta {:.2f} deg already, and part again between samples",
                                 to_degrees(*proven.contact)));
  sampled = {proven.theta, true, proven.walls};
}

void correct_samples(Run& run) {
  if (!run.plan.free_range || !run.certified->designed) return;
  correct(run.plan.free_range->negative, run.certified->designed.negative, run.plan);
  correct(run.plan.free_range->positive, run.certified->designed.positive, run.plan);
}

/// Walls that do overlap on the way to a goal, whichever states its search has looked at.
void judge_contact(Run& run) {
  const model::CertifiedLimit& limit = run.certified->designed.to(run.theta);
  if (!run.goal || run.plan.model != Model::exact || !limit.contact ||
      std::abs(*limit.contact) >= std::abs(run.theta))
    return;
  const auto [first, second] = wall_names(limit, run.structure);
  run.goal->violations.push_back(
      fmt::format("walls {} and {} overlap at theta {:.3f} deg, on the way to {:.3f} deg", first, second,
                  to_degrees(*limit.contact), to_degrees(run.theta)));
}

/// What is proven of walls where they are out of place, of the states that prints are judged in.
void judge_contact_of_prints(Run& run) {
  const bool has_left = run.equilibrium && run.equilibrium->path.off_closed_form;
  if (!run.printed || has_left || !run.certified->printed) return;
  run.printed->free_of_contact = run.certified->covers_printed(run.theta);
}

}  // namespace

Judgement judgement(const Run& run, const Scene& scene, const RunOptions& options) {
  Judgement out;
  Stopwatch watch;
  prove_range(run, options, out);
  out.certify_s = watch.lap();
  judge_prints(run, scene, options, out);
  out.as_made_s = watch.lap();
  return out;
}

void add(Judgement judgement, Run& run) {
  run.timings.as_made = judgement.as_made_s;
  run.timings.certify = judgement.certify_s;
  if (judgement.printed) run.printed = std::move(judgement.printed);
  if (!judgement.prints_unknown.empty()) {
    run.prints_unknown = std::move(judgement.prints_unknown);
    run.plan.why.push_back("what prints come to is not known: " + run.prints_unknown);
  }
  if (!judgement.certified) return;
  run.certified = std::move(judgement.certified);
  correct_samples(run);
  judge_contact(run);
  judge_contact_of_prints(run);
}

}  // namespace kinetix::app
