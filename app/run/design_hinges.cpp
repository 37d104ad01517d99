#include "app/run/design_hinges.hpp"

#include <fmt/format.h>

namespace kinetix::app {

const HingeSection& hinge_section(const Design& design, int hinge) {
  return hinge_at(design.hinge, design.hinge_overrides, hinge);
}

std::vector<model::ManufacturedHinge> manufactured_hinges(const Design& design) {
  std::vector<model::ManufacturedHinge> all;
  const auto add = [&](const HingeSection& hinge) {
    if (hinge.made && std::find(all.begin(), all.end(), *hinge.made) == all.end()) all.push_back(*hinge.made);
  };
  if (static_cast<int>(design.hinge_overrides.size()) < design.structure.hinges()) add(design.hinge);
  for (const auto& [h, own] : design.hinge_overrides) add(own);
  return all;
}

bool leaves_hinges_open(const Design& design) {
  const auto all = hinge_sections(design);
  return std::any_of(all.begin(), all.end(), [](const HingeSection* hinge) { return !hinge->made; });
}

bool has_pins_alone(const Design& design) {
  const auto made = manufactured_hinges(design);
  return !leaves_hinges_open(design) &&
         std::all_of(made.begin(), made.end(), [](const auto& h) { return is_pin(h.kind); });
}

bool is_usual_drive(const model::LinkageDrive& drive, const Design& design) {
  const model::LinkageDrive usual = drive_to(design.structure, design.theta);
  return drive.kind == usual.kind && drive.axis == usual.axis && drive.hinge == usual.hinge;
}

Design with_manufactured_hinges(const Design& design, const std::vector<model::ManufacturedHinge>& made) {
  Design out = design;
  for (int h = 0; h < static_cast<int>(made.size()); ++h) {
    HingeSection hinge = hinge_section(design, h);
    if (hinge.made) continue;
    hinge.made = made[h];
    const bool is_common = !design.hinge_overrides.contains(h) && out.hinge.made.value_or(made[h]) == made[h];
    (is_common ? out.hinge : out.hinge_overrides[h]) = hinge;
  }
  return out;
}

Design with_open_joints(Design design) {
  if (design.hinge.model != HingeSection::Model::rotary) return design;
  design.hinge.made.reset();
  design.hinge_overrides.clear();
  return design;
}

std::optional<model::ManufacturedHinge> loosest_pin(const Design& design) {
  std::optional<model::ManufacturedHinge> loosest;
  for (const model::ManufacturedHinge& made : manufactured_hinges(design))
    if (is_pin(made.kind) && !made.with_play && (!loosest || made.clearance_mm > loosest->clearance_mm))
      loosest = made;
  return loosest;
}

model::PrintError wall_error(const Design& design) {
  model::PrintError error = design.process.sd;
  const auto pin = loosest_pin(design);
  if (!pin) return error;
  const model::ClearanceScatter play = clearance_scatter(*pin, design.process.sd);
  error.t_mm = std::hypot(error.t_mm, play.place_mm);
  error.tilt_deg = std::hypot(error.tilt_deg, to_degrees(play.tilt));
  return error;
}

bool withstands_strain(const Design& design, const model::State& state) {
  return !describe_overstrain(design, state);
}

std::optional<std::string> describe_overstrain(const Design& design, const model::State& state) {
  const auto worst =
      most_strained(model::Linkage(design.structure), state, [&](int h) -> const model::ManufacturedHinge* {
        const auto& made = hinge_section(design, h).made;
        return made ? &*made : nullptr;
      });
  if (!worst) return std::nullopt;
  return describe_strain(*worst, wall_name(design.structure, worst->hinge));
}

std::string describe_strain(const model::StrainedHinge& worst, const std::string& wall, const char* when) {
  return fmt::format(
      "the hinge of wall {} is strained by {:.3g}{}, the limit of its material is {:g}. Use a longer gap or "
      "a "
      "thinner hinge",
      wall, worst.strain, when, worst.borne);
}

std::vector<model::PrintProblem> print_problems(const Design& design) {
  const model::CellSize size = design.structure.size();
  std::vector<model::PrintProblem> all = print_problems(design.process, size, std::nullopt);
  for (const model::ManufacturedHinge& made : manufactured_hinges(design))
    for (const model::PrintProblem& problem : print_problems(design.process, size, made))
      if (std::none_of(all.begin(), all.end(), [&](const auto& p) { return p.what == problem.what; }))
        all.push_back(problem);
  return all;
}

}  // namespace kinetix::app
