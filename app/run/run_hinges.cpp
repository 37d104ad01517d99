#include "app/run/run_hinges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinetix::app {

const HingeSection& hinge_section(const Run& run, int hinge) {
  return hinge_at(run.hinge, run.own_hinges, hinge);
}

std::vector<model::MadeHinge> made_hinges(const Run& run) {
  std::vector<model::MadeHinge> all;
  const auto add = [&](const HingeSection& hinge) {
    if (hinge.made && std::find(all.begin(), all.end(), *hinge.made) == all.end()) all.push_back(*hinge.made);
  };
  if (static_cast<int>(run.own_hinges.size()) < run.structure.hinges()) add(run.hinge);
  for (const auto& [h, own] : run.own_hinges) add(own);
  return all;
}

std::optional<model::MadeHinge> loosest_pin(const Run& run) {
  std::optional<model::MadeHinge> loosest;
  for (const model::MadeHinge& made : made_hinges(run))
    if (made.kind == model::HingeKind::pin && !made.with_play &&
        (!loosest || made.clearance_mm > loosest->clearance_mm))
      loosest = made;
  return loosest;
}

model::PrintError wall_error(const Run& run) {
  model::PrintError error = run.process.sd;
  const auto pin = loosest_pin(run);
  if (!pin) return error;
  const model::PlayScatter play = play_scatter(*pin, run.process.sd);
  error.t_mm = std::hypot(error.t_mm, play.place_mm);
  error.tilt_deg = std::hypot(error.tilt_deg, to_degrees(play.tilt));
  return error;
}

bool bears_its_strain(const Run& run, const model::State& state) { return !strained_too_far(run, state); }

std::optional<std::string> strained_too_far(const Run& run, const model::State& state) {
  const auto worst =
      most_strained(model::Linkage(run.structure), state, [&](int h) -> const model::MadeHinge* {
        const auto& made = hinge_section(run, h).made;
        return made ? &*made : nullptr;
      });
  if (!worst) return std::nullopt;
  return strained_words(*worst, wall_name(run.structure, worst->hinge));
}

std::string strained_words(const model::StrainedHinge& worst, const std::string& wall, const char* when) {
  return fmt::format(
      "the hinge of wall {} is strained by {:.3g}{}; its material bears {:g}: a longer gap or a thinner "
      "hinge "
      "strains less",
      wall, worst.strain, when, worst.borne);
}

std::vector<model::PrintProblem> print_problems(const Run& run) {
  const model::CellSize size = run.structure.size();
  std::vector<model::PrintProblem> all = print_problems(run.process, size, std::nullopt);
  for (const model::MadeHinge& made : made_hinges(run))
    for (const model::PrintProblem& problem : print_problems(run.process, size, made))
      if (std::none_of(all.begin(), all.end(), [&](const auto& p) { return p.what == problem.what; }))
        all.push_back(problem);
  return all;
}

}  // namespace kinetix::app
