#include <algorithm>
#include <cmath>

#include "model/wall_contact.hpp"
#include "tests/support/hard/kit.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::testing {
namespace {

using Kind = PathEvent::Kind;
using Mark = HardAnswer::Mark;

/// Contact in the step in which the closed form's walls close; then a lock, soon after.
HardAnswer overdrive(const HardScene& scene) {
  const LoadPath path = followed(scene);
  const ThetaRange range = theta_range(scene.structure, classify(scene.structure));
  const double side = scene.drive.theta() < 0 ? -1 : 1;
  const double limit = side * (side < 0 ? range.negative : range.positive).theta;
  const PathEvent *contact = first_event(path, Kind::contact), *lock = first_event(path, Kind::lock);
  HardAnswer a = answer(scene, path, false, path.why);
  a.exact = text("walls close at %.2f deg", to_degrees(limit));
  if (!contact || !lock) return a;
  const bool brackets = side * contact->since <= limit + 2e-3 && side * contact->at.theta >= limit - 2e-3;
  if (brackets && side * lock->at.theta <= limit + 10 * deg) a.mark = Mark::diagnosed;
  a.equilibrium += text("; lock under %.3g N", lock->at.load);
  return a;
}

HardScene pressed_panel(double theta, double contact_ratio = 10) {
  HardScene scene{make_structure(rectangle(4, 4), {}), plates_drive(Axis::y, theta), {}, true};
  scene.elasticity.k_contact = contact_ratio * scene.elasticity.k_point;
  return scene;
}

HardAnswer lock_grid_that_shears() {
  const Structure s = uncrossable_grid();
  return overdrive({s, drive_to(s, -67.5 * deg), {}, true});
}

}  // namespace

HardCases wall_cases() {
  const char* asked = "contact where the closed form closes, to 2e-3 rad; a lock within 10 deg of theta";
  HardCases cases;
  for (const double theta : {50.0, 80.0})
    cases.push_back({text("4x4 panel, plates to theta = %g deg: past its lock", theta), asked,
                     [=] { return overdrive(pressed_panel(theta * deg)); }});
  for (const double ratio : {0.1, 1e3})
    cases.push_back({text("the same to 50 deg, contact %g times as stiff as hinges", ratio), asked,
                     [=] { return overdrive(pressed_panel(50 * deg, ratio)); }, ratio > 1});
  cases.push_back(
      {"3x5 grid that shears, hinge to phi = 135 deg: past its lock", asked, lock_grid_that_shears});
  return cases;
}

}  // namespace kinetix::testing
