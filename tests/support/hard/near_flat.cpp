#include <cmath>

#include "model/closure/closure.hpp"
#include "tests/support/hard/kit.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::testing {
namespace {

using Stop = model::EquilibriumPath::Stop;

model::Structure panel() { return make_structure(model::rectangle(3, 3), {}); }

HardAnswer stay_flat(const HardScene& scene) {
  const model::EquilibriumPath path = followed(scene);
  const double moved = aligned_distance(scene.structure, path.state, rest_state(scene.structure)).max;
  return answer(scene, path, path.stop == Stop::reached && moved <= 1e-9, text("moved by %.1e", moved));
}

/// A panel of n x n cells under a plate holds against its turning springs up to the compressing force 4 N k /
/// (n L).
double buckling_compression(const model::Structure& s, const model::Elasticity& e, int n) {
  const double force = 4.0 * static_cast<double>(s.hinges.size()) * e.k_turn / (n * s.size.edge_mm);
  return force / (2 * e.k_point * s.size.edge_mm * (n + 1));
}

HardAnswer buckle(double over) {
  HardScene scene{panel(), {}, {}, true};
  const double critical = buckling_compression(scene.structure, scene.elasticity, 3);
  scene.drive = model::Plates{.compression = over * critical};
  const model::EquilibriumPath path = followed(scene);
  const int hinge = *scene.structure.hinge_at({{1, 1}, model::Axis::x});
  const double turn = std::abs(hinge_turn(scene.structure, path.state, hinge));
  const double expected = 2 * std::sqrt(2 * critical * std::max(0.0, over - 1));
  HardAnswer a =
      answer(scene, path, path.stop == Stop::reached && std::abs(turn - expected) <= 0.05 * expected + 1e-9,
             text("hinges turn by %.3g rad", turn));
  a.exact = text("to first order %.3g rad", expected);
  return a;
}

model::Structure even_panel() { return make_structure(model::rectangle(4, 3), {}); }

/// The mirror image of each is the other, so neither side is favoured.
HardScene imperfect(double by, double theta) {
  HardScene scene{even_panel(), plates_drive(model::Axis::y, theta), {}, true};
  model::Structure& s = scene.structure;
  s.hinges[*s.hinge_at({{0, 1}, model::Axis::x})].parameters.t += by;
  s.hinges[*s.hinge_at({{3, 1}, model::Axis::x})].parameters.t -= by;
  return scene;
}

double from_perfect(const model::EquilibriumPath& path) { return from_closed_form(even_panel(), path); }

HardAnswer opposite_imperfections(double by) {
  const HardScene scene = imperfect(by, 30 * deg);
  const model::EquilibriumPath one = followed(scene), other = followed(imperfect(by, -30 * deg));
  const double rms = std::max(from_perfect(one), from_perfect(other)),
               apart = std::abs(one.steps.back().energy / other.steps.back().energy - 1);
  const bool ends = one.stop == Stop::reached && other.stop == Stop::reached;
  HardAnswer a = answer(scene, one, ends && rms <= 2 * by + 1e-4 && apart <= 1e-9,
                        text("rms %.1e from the perfect panel, other branch's energy by %.1e", rms, apart));
  a.exact =
      text("perfect panel: E %.4g N mm", planar_energy(even_panel(), scene.elasticity.k_turn, one.theta));
  return a;
}

void add_small_turns(HardCases& cases) {
  for (const bool grid : {true, false})
    for (const double theta : {1e-3, 1e-6, 1e-9}) {
      const char* name = grid ? "3x5 grid that scales" : "bending strip";
      cases.push_back(closed_form_case(
          text("%s, hinge to theta = %g", name, theta),
          [=] {
            const model::Structure s = grid ? crossable_grid() : bending_strip();
            return HardScene{s, hinge_drive(s, {{0, 0}, model::Axis::y}, theta), of_ratio(1e-8)};
          },
          1e-3 * theta));
    }
  cases.push_back({"3x3 panel, drive of nothing at all", "flat", [] {
                     return stay_flat({panel(), {}, {}, true});
                   }});
  cases.push_back({"3x3 panel, plates to theta = 1e-6", "far below buckling: flat", [] {
                     return stay_flat({panel(), plates_drive(model::Axis::y, 1e-6), {}, true});
                   }});
}

}  // namespace

HardCases near_flat_cases() {
  HardCases cases;
  add_small_turns(cases);
  for (const double over : {0.9, 0.999, 1.001, 1.1, 2.0})
    cases.push_back({text("3x3 panel, plates to %g of its buckling compression", over),
                     over < 1 ? "flat" : "turns of the buckled column to 5 %", [=] { return buckle(over); }});
  for (const double by : {1e-3, 1e-6, 1e-9})
    cases.push_back(
        {text("4x3 panel, plates, two exactly opposite imperfections of t by %g", by),
         text("perfect panel on both branches, rms <= %.1e; their energies to 1e-9", 2 * by + 1e-4),
         [=] { return opposite_imperfections(by); }});
  return cases;
}

}  // namespace kinetix::testing
