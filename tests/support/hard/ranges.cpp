#include <algorithm>
#include <cmath>

#include "tests/support/hard/kit.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::testing {
namespace {

HardScene tilted_cell(double alpha, double theta) {
  const model::Structure s = alternating(1, 1, {.alpha = alpha * deg}, basic_unit);
  return {s, hinge_drive(s, {{0, 0}, model::Axis::y}, theta), {}};
}

/// Mirrored in its own plane, alpha becomes its supplement, and theta stays.
HardAnswer follow_with_mirror_image(double alpha, double theta) {
  HardAnswer a = follow_strained(tilted_cell(alpha, theta), 1e-3);
  const double energy = followed_finely(tilted_cell(alpha, theta)).steps.back().energy,
               mirrored = followed_finely(tilted_cell(180 - alpha, theta)).steps.back().energy,
               apart = std::abs(mirrored / energy - 1);
  a.equilibrium += text(", mirror image by %.1e", apart);
  if (!(apart <= 1e-6)) a.mark = HardAnswer::Mark::wrong;
  return a;
}

/// Arms of t L make a hinge's stiffness count 1 / t^2 times as much.
HardCase short_arms(double t, double ratio) {
  const double arm = std::min(t, 1 - t), allowed = ratio / (arm * arm);
  return closed_form_case(
      text("3x3 grid, t = %g, theta = 30 deg, stiffness ratio %.0e", t, 1 / ratio),
      [=] {
        const model::Structure s = crossable_grid(t, 3, 3);
        return HardScene{s, drive_to(s, 30 * deg), of_ratio(ratio)};
      },
      allowed);
}

void add_fractions(HardCases& cases) {
  for (const double t : {1e-3, 1 - 1e-3})
    for (const double ratio : {1e-8, 1e-12}) cases.push_back(short_arms(t, ratio));
}

HardCase steep_strip(double beta, bool plates) {
  HardCase c = closed_form_case(
      text("strip, beta = %g deg, %s to theta = 10 deg", beta, plates ? "plates" : "hinge"),
      [=] {
        const model::Structure s = alternating(6, 1, {.beta = beta * deg}, basic_unit);
        return HardScene{s,
                         plates ? plates_drive(model::Axis::y, 10 * deg)
                                : hinge_drive(s, {{0, 0}, model::Axis::y}, 10 * deg),
                         of_ratio(1e-8)};
      },
      1e-4);
  c.in_tests = !plates;
  return c;
}

void add_tilts(HardCases& cases) {
  for (const double beta : {89.0, -89.0})
    for (const bool plates : {true, false}) cases.push_back(steep_strip(beta, plates));
  for (const double alpha : {1.0, 179.0})
    for (const double theta : {0.1, -0.1})
      cases.push_back({text("cell with alpha = %g deg, hinge to theta = %g rad", alpha, theta),
                       "work is energy to 1e-3; energy of its mirror image to 1e-6",
                       [=] { return follow_with_mirror_image(alpha, theta); }});
}

void add_stiffness_ratios(HardCases& cases) {
  const auto strip = [](double ratio) {
    const model::Structure s = bending_strip();
    return HardScene{s, drive_to(s, 30 * deg), of_ratio(ratio)};
  };
  for (const double ratio : {1e-4, 1e-6, 1e-8, 1e-10})
    cases.push_back(closed_form_case(
        text("bending strip, stiffness ratio %.0e", 1 / ratio), [=] { return strip(ratio); }, 100 * ratio));
  for (const double ratio : {1.0, 1e-2}) {
    cases.push_back({text("bending strip, stiffness ratio %g", 1 / ratio), "work is energy to 1e-3",
                     [=] { return follow_strained(strip(ratio), 1e-3); }});
    cases.push_back({text("3x5 grid that scales, hinge to phi = 20 deg, stiffness ratio %g", 1 / ratio),
                     "work is energy to 1e-3", [=] {
                       return follow_strained(
                           {crossable_grid(),
                            hinge_drive(crossable_grid(), {{0, 0}, model::Axis::y}, 10 * deg),
                            of_ratio(ratio)},
                           1e-3);
                     }});
  }
}

}  // namespace

HardCases range_cases() {
  HardCases cases;
  add_fractions(cases);
  add_tilts(cases);
  add_stiffness_ratios(cases);
  return cases;
}

}  // namespace kinetix::testing
