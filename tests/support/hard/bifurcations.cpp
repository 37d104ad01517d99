#include <algorithm>

#include "tests/support/hard/kit.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::testing {
namespace {

using Kind = model::PathEvent::Kind;
// rad, theta at which the bars of a grid lie in line and another motion without strain begins.
constexpr double bars_in_line = 45 * deg;

bool reports_branching(const model::EquilibriumPath& path) {
  return std::any_of(path.events.begin(), path.events.end(), [](const model::PathEvent& e) {
    return (e.kind == Kind::bifurcation || e.kind == Kind::snap) && e.since <= bars_in_line + deg &&
           e.at.theta >= bars_in_line - deg;
  });
}

/// Follows a path past the point where all bars are in line. Other motions without strain begin there. An equilibrium
/// of one of these counts as diagnosed if the path reports the branching.
HardAnswer follow_through(const HardScene& scene, double allowed) {
  HardAnswer a = follow_closed_form(scene, allowed);
  if (a.mark == HardAnswer::Mark::right) return a;
  const model::EquilibriumPath path = followed(scene);
  if (path.stop == model::EquilibriumPath::Stop::reached && path.gaps.max <= 1e-4 && reports_branching(path))
    a.mark = HardAnswer::Mark::diagnosed;
  return a;
}

HardCase grid_case(bool scales, double k, double phi) {
  const double allowed = phi < 90 ? 1e-4 : 5e-3;
  return {text("3x5 grid that %s, k = %.6g, hinge to phi = %g deg", scales ? "scales" : "shears", k, phi),
          text("closed form, rms <= %.0e%s", allowed, phi > 90 ? ", or the branching told" : ""), [=] {
            const model::Structure s = scales ? crossable_grid(k) : uncrossable_grid(k);
            return follow_through(
                {s, hinge_drive(s, {{0, 0}, model::Axis::y}, phi / 2 * deg), of_ratio(1e-12)}, allowed);
          }};
}

}  // namespace

HardCases bifurcation_cases() {
  HardCases cases;
  for (const bool scales : {true, false})
    for (const double k : {0.49, 0.51, 0.4999, 0.5001, 0.499999, 0.500001, 0.5})
      for (const double phi : {89.9, 90.0, 100.0}) cases.push_back(grid_case(scales, k, phi));
  return cases;
}

}  // namespace kinetix::testing
