#include <algorithm>

#include "tests/support/hard/kit.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::testing {
namespace {

HardScene fold_by_30(const model::Structure& s, double ratio = 1e-6) {
  return {s, drive_to(s, 30 * deg), of_ratio(ratio)};
}

HardCase large(std::string name, std::function<model::Structure()> make, double allowed) {
  HardCase c = closed_form_case(
      std::move(name), [=] { return fold_by_30(make()); }, allowed);
  c.in_tests = false;
  return c;
}

model::Structure bending_by(double tilt) { return alternating(1000, 1, {.beta = tilt}, basic_unit); }

bool reports_instability(const std::string& text) {
  return text.find("analytic motion is unstable") != std::string::npos;
}

/// Checks a strip beyond its tipping length. Its closed form is not a minimum: an elastic one takes less energy.
HardAnswer tip_over(const HardScene& scene) {
  const model::EquilibriumPath path = followed(scene);
  const model::State exact = fold(classify(scene.structure), scene.structure, path.theta);
  const double energy = path.steps.back().energy, folded = energy_of(scene, exact);
  const bool reported = std::any_of(path.events.begin(), path.events.end(),
                                    [](const model::PathEvent& e) { return reports_instability(e.what); });
  HardAnswer a = answer(scene, path, false,
                        text("to theta %.3g deg; closed form there: E %.4g N mm%s", to_degrees(path.theta),
                             folded, reported ? ", told to be unstable" : ""));
  a.exact = text("tips over beyond %.0f cells", tipping_length(scene.elasticity));
  if (reported && path.steps.back().stable && energy < folded) a.mark = HardAnswer::Mark::diagnosed;
  return a;
}

}  // namespace

HardCases size_cases() {
  HardCases cases;
  for (const int n : {30, 100})
    cases.push_back(large(
        text("panel of %d x %d basic cells", n, n),
        [=] { return make_structure(model::rectangle(n, n), {}); }, 1e-3));
  cases.push_back(large(
      "strip of 1000 basic cells", [] { return make_structure(model::rectangle(1000, 1), {}); }, 1e-2));
  cases.push_back(closed_form_case(
      "strip of 1000 cells that bends by half a degree a pair, stiffness ratio 1e-7",
      [] { return fold_by_30(bending_by(0.5 * deg), 1e-7); }, 1e-2));
  cases.push_back({"strip of 1000 cells that bends by half a degree a pair",
                   "tips over between its plates: the closed form told to be unstable, and of more energy",
                   [] { return tip_over(fold_by_30(bending_by(0.5 * deg))); }, false});
  return cases;
}

}  // namespace kinetix::testing
