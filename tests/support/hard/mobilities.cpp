#include <cmath>
#include <functional>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/mobility.hpp"
#include "tests/support/hard/kit.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::testing {
namespace {

using Mark = HardAnswer::Mark;
using Stop = model::EquilibriumPath::Stop;

model::Structure make_two_cells_at_corner() { return model::make_structure({{0, 0}, {1, 1}}, {}); }
model::Structure staircase() { return model::make_structure({{0, 0}, {1, 1}, {2, 2}, {3, 3}}, {}); }

HardScene between_plates(const model::Structure& s) {
  return {s, plates_drive(model::Axis::y, 30 * deg), of_ratio(1e-6), true};
}

/// With more degrees of freedom than the one of the closed form, the cells share the turns at the least energy.
HardAnswer share_turns() {
  const HardScene scene = between_plates(staircase());
  const model::EquilibriumPath path = followed_finely(scene);
  const double shared = planar_energy(scene.structure, scene.elasticity.k_turn, 30 * deg);
  const double energy = path.steps.back().energy, off = std::abs(work_of(scene, path) / energy - 1);
  HardAnswer a = answer(scene, path,
                        path.stop == Stop::reached && path.gaps.max <= 1e-4 && energy < shared && off <= 1e-2,
                        text("work differs by %.1e", off));
  a.exact = text("all cells alike: E %.4g N mm", shared);
  return a;
}

HardAnswer drive_one_of_two() {
  const HardScene scene{make_two_cells_at_corner(),
                        hinge_drive(make_two_cells_at_corner(), {{0, 0}, model::Axis::y}, 30 * deg),
                        {},
                        true};
  const model::Structure& s = scene.structure;
  const model::EquilibriumPath path = followed(scene);
  const model::Mobility m = mobility(s, exact_motion(s));
  double worst = 0;
  for (std::size_t h = 0; h < s.hinges.size(); ++h) {
    const bool driven_cell =
        s.hinges[h].wall.from <= model::Vertex{1, 0} && s.hinges[h].wall.to() <= model::Vertex{1, 1};
    const double turn = std::abs(hinge_turn(s, path.state, static_cast<int>(h)));
    worst = std::max(worst, std::abs(turn - (driven_cell ? 60 * deg : 0)));
  }
  HardAnswer a = answer(scene, path, path.stop == Stop::reached && m.dofs_along == 2 && worst <= 1e-5,
                        text("turns to %.1e rad, %d degrees of freedom", worst, m.dofs_along));
  a.exact = "driven cell folds, the other stays flat";
  return a;
}

HardAnswer drive_immobile(const std::function<model::Drive(const model::Structure&)>& drive_of) {
  std::mt19937 random(7);
  const model::Structure panel = random_panel(3, 3, random);
  const HardScene scene{panel, drive_of(panel), {}};
  const model::Mobility m = mobility(scene.structure, exact_motion(scene.structure));
  HardAnswer a = follow_strained(scene, 1e-2);
  a.exact = to_string(m.verdict);
  if (m.verdict != model::Verdict::not_mobile) a.mark = Mark::wrong;
  return a;
}

HardAnswer disconnected() {
  try {
    model::make_structure({{0, 0}, {5, 5}}, {});
  } catch (const InvalidInput& e) {
    return {Mark::diagnosed, "", std::string("refused: ") + e.what(), {}};
  }
  return {Mark::wrong, "", "accepted", {}};
}

}  // namespace

HardCases mobility_cases() {
  const char* strained = "immobile; work is energy to 1e-2";
  return {{"cells that do not hang together", "refused", disconnected},
          closed_form_case(
              "two cells that touch in one corner only, plates",
              [] { return between_plates(make_two_cells_at_corner()); }, 1e-4),
          {"four cells in a row of corners, plates (M = 4)",
           "no strain; less energy than all cells alike; work is energy to 1e-2", share_turns},
          {"two cells that touch in one corner only, one driven (M = 2)",
           "two degrees of freedom; turns of both to 1e-5 rad", drive_one_of_two},
          {"3x3 panel with random hinges (M = 0), hinge to 20 deg", strained,
           [] {
             return drive_immobile([](const model::Structure& panel) {
               return hinge_drive(panel, model::Wall{{1, 1}, model::Axis::y}, 10 * deg);
             });
           }},
          {"3x3 panel with random hinges (M = 0), plates to theta = 10 deg", strained, [] {
             return drive_immobile(
                 [](const model::Structure&) { return plates_drive(model::Axis::y, 10 * deg); });
           }}};
}

}  // namespace kinetix::testing
