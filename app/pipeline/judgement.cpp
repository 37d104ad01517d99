#include "app/pipeline/judgement.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "app/pipeline/as_made.hpp"
#include "app/pipeline/certify.hpp"
#include "app/run/contact_reason.hpp"
#include "app/run/design_hinges.hpp"
#include "app/run/stopwatch.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

/// Puts right one end of a range whose samples have missed walls that touch before.
void correct(model::ContactLimit& sampled, const model::ContactLimit& proven, Plan& plan) {
  if (!proven.contact || std::abs(sampled.theta) <= std::abs(*proven.contact)) return;
  plan.why.push_back(fmt::format("walls touch at theta {:.2f} deg already, and part again between samples",
                                 to_degrees(*proven.contact)));
  sampled = proven;
}

Plan corrected(Plan plan, const ProvenRanges& certified) {
  if (!plan.free_range || !certified.designed) return plan;
  correct(plan.free_range->negative, certified.designed.negative, plan);
  correct(plan.free_range->positive, certified.designed.positive, plan);
  return plan;
}

/// Walls that do overlap on the way to a goal, whichever states its search has looked at. Where nothing was to be proven those that
/// overlap as built are seen in the flat state.
std::optional<std::string> why_walls_meet(const Run& run) {
  if (!run.goal || run.plan.model != Model::exact) return std::nullopt;
  if (run.certified) return run.certified->designed ? contact_reason(run) : std::nullopt;
  if (!run.plan.exact || run.theta == 0) return std::nullopt;
  const model::Linkage linkage = run.design.structure;
  const model::WallContact contact(linkage);
  const auto& overlap = contact.overlap_at_rest();
  return overlap ? std::optional(overlap_words(*overlap, run.design.structure)) : std::nullopt;
}

/// What is proven of walls where they are out of place, of the states that prints are judged in. Of equilibria near the closed
/// form nothing is; that even this form may touch is a warning all the same.
std::optional<bool> are_prints_free(const Run& run) {
  const bool has_left = run.equilibrium && run.equilibrium->path.off_closed_form;
  if (!run.printed || !run.certified || has_left || !run.certified->printed) return std::nullopt;
  const bool is_free = run.certified->printed.covers(run.theta) && !run.printed->touches_too_often();
  return run.equilibrium && is_free ? std::nullopt : std::optional(is_free);
}

}  // namespace

Judging::Judging(const Run& run, const Goal* goal, const RunOptions& options)
    : run_(run), goal_(goal), options_(options) {}

void Judging::work() {
  constexpr std::array parts{&Judging::judge_prints, &Judging::prove_range, &Judging::ask_export};
  for (int k = begun_++; k < static_cast<int>(parts.size()); k = begun_++)
    if (!options_.stop.stop_requested()) (this->*parts[k])();
}

void Judging::judge_prints() {
  if (!goal_ || run_.states.empty()) return;
  if (run_.matter && !run_.equilibrium) {
    found_.prints_unknown = "elastic hinges find no equilibrium near the design: " + run_.matter->why;
    return;
  }
  Stopwatch watch;
  const model::State& state = run_.matter ? run_.equilibrium->path.state : run_.own;
  const auto observed = goal_->observe(run_, run_.design.structure, state);
  if (!observed) return;
  found_.printed =
      as_made(run_, run_.matter ? run_.equilibrium->drive : drive_to(run_.design.structure, run_.theta),
              state, observed->points, options_);
  if (found_.printed)
    found_.printed->tolerance_mm = observed->tolerance_mm;
  else
    found_.prints_unknown = "elastic hinges have no stable state near the design under its drive";
  found_.as_made_s = watch.lap();
}

void Judging::prove_range() {
  if (!options_.certify) return;
  Stopwatch watch;
  found_.certified =
      certify(run_.design.structure, run_.plan, wall_error(run_.design), options_.threads, options_.stop);
  found_.certify_s = watch.lap();
}

void Judging::ask_export() {
  if (run_.goal && !run_.states.empty() && options_.printable)
    found_.print = options_.printable(written_design(run_));
}

Run with_judgement(Run run, Judgement judgement) {
  run.timings.as_made = judgement.as_made_s;
  run.timings.certify = judgement.certify_s;
  if (judgement.printed) {
    run.printed = std::move(judgement.printed);
    if (judgement.print) run.printed->can_be_printed = judgement.print->is_taken;
  }
  run.print = std::move(judgement.print);
  if (!judgement.prints_unknown.empty()) {
    run.prints_unknown = std::move(judgement.prints_unknown);
    run.plan.why.push_back("what prints come to is not known: " + run.prints_unknown);
  }
  run.certified = std::move(judgement.certified);
  if (run.certified) run.plan = corrected(std::move(run.plan), *run.certified);
  if (const auto why = why_walls_meet(run)) run.violations.push_back(*why);
  if (const auto free = are_prints_free(run)) run.printed->free_of_contact = *free;
  return run;
}

}  // namespace kinetix::app
