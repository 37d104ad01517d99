#include <algorithm>
#include <cmath>

#include "model/contact/wall_contact.hpp"
#include "model/elastic/elastic_system.hpp"
#include "tests/support/hard/kit.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::testing {
namespace {

using Kind = model::PathEvent::Kind;
using Mark = HardAnswer::Mark;

struct Watched {
  model::EquilibriumPath path;
  int passed = 0;  ///< steps in which walls went through each other
};

Watched watched(const HardScene& scene) {
  Watched run;
  model::State before;
  const bool planar = all_vertical(scene.structure);
  const model::ElasticSystem system(scene.structure, scene.elasticity, drive_on(scene.structure, scene.drive),
                                    planar, true);
  run.path = trace_equilibrium(driven(scene.structure, scene.drive), scene.elasticity, {},
                               [&](const model::EquilibriumStep&, const model::State& s) {
                                 run.passed += !before.empty() && system.passed_through(before, s);
                                 before = s;
                               });
  return run;
}

bool reports_passing_walls(const model::EquilibriumPath& path) {
  const auto says = [](const std::string& words) { return words.find("through") != std::string::npos; };
  return says(path.why) || std::any_of(path.events.begin(), path.events.end(),
                                       [&](const model::PathEvent& e) { return says(e.what); });
}

bool is_near(const model::PathEvent* event, double side, double from, double to) {
  return event && side * event->since <= to && side * event->at.theta >= from;
}

/// Contact in the step in which the closed form's walls close, a lock soon after, and no wall that goes
/// through another without a word.
HardAnswer overdrive(const HardScene& scene) {
  const Watched run = watched(scene);
  const model::ContactRange range = theta_range(scene.structure, exact_motion(scene.structure));
  const double side = scene.theta() < 0 ? -1 : 1;
  const double limit = side * (side < 0 ? range.negative : range.positive).theta;
  const bool right = is_near(first_event(run.path, Kind::contact), side, limit - 2e-3, limit + 2e-3) &&
                     is_near(first_event(run.path, Kind::lock), side, limit - 2e-3, limit + 10 * deg) &&
                     (run.passed == 0 || reports_passing_walls(run.path));
  HardAnswer a = answer(scene, run.path, false,
                        text("load %.4g at %.4g deg, walls passed through others in %d steps",
                             run.path.steps.back().load, to_degrees(run.path.theta), run.passed));
  if (right) a.mark = Mark::diagnosed;
  a.exact = text("walls close at %.2f deg", to_degrees(limit));
  return a;
}

HardScene pressed_panel(double theta, double contact_ratio) {
  HardScene scene{make_structure(model::rectangle(4, 4), {}), plates_drive(model::Axis::y, theta), {}, true};
  scene.elasticity.k_contact = contact_ratio * scene.elasticity.k_point;
  return scene;
}

HardAnswer lock_grid_that_shears() {
  const model::Structure s = uncrossable_grid();
  return overdrive({s, drive_to(s, -67.5 * deg), {}, true});
}

}  // namespace

HardCases wall_cases() {
  const char* asked =
      "contact where the closed form closes, to 2e-3 rad; a lock within 10 deg of theta; no wall "
      "through another untold";
  struct Press {
    double theta, ratio;
    bool in_tests;
  };
  HardCases cases;
  for (const auto& [theta, ratio, in_tests] :
       {Press{50, 0.1, false}, Press{50, 10, false}, Press{50, 1e3, true}, Press{50, 1e6, true},
        Press{80, 0.1, false}, Press{80, 10, false}, Press{80, 1e3, false}, Press{80, 1e6, true}})
    cases.push_back(
        {text("4x4 panel, plates to theta = %g deg, contact %g times as stiff as hinges", theta, ratio),
         asked, [theta = theta, ratio = ratio] { return overdrive(pressed_panel(theta * deg, ratio)); },
         in_tests});
  cases.push_back(
      {"3x5 grid that shears, hinge to phi = 135 deg: past its lock", asked, lock_grid_that_shears, false});
  return cases;
}

}  // namespace kinetix::testing
