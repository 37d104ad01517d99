#include "benchmarks/equilibrium_against_physics.hpp"
#include "benchmarks/matter_parts.hpp"
#include "model/matter/made_hinge.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::bench {
namespace {

/// Soft blocks between the half walls of the scenes, 6 mm high: along the wall six times as stiff as across it.
model::Elasticity rubber_blocks() {
  return elasticity_of(model::MadeHinge{.kind = model::HingeKind::block,
                                        .material = *model::find_material("tango"),
                                        .gap_mm = 1,
                                        .thickness_mm = 0.8,
                                        .height_mm = 6});
}

}  // namespace

std::vector<Figure> framed_physics_figures() {
  constexpr double degree = radians_per_degree;
  const model::Structure letter = testing::letter_panel(0.15), strip = testing::twisting_strip(),
                         sheet = testing::alternating(8, 8, testing::twisting_unit, testing::basic_unit);
  const std::string blocks = ", rubber blocks of 1 x 0.8 mm";
  return {equilibrium_against_physics("letter T, 10 x 10, k = 0.15, 16 % compression" + blocks, letter,
                                      testing::plates_drive(model::Axis::y, std::acos(0.84)).on(letter),
                                      rubber_blocks()),
          equilibrium_against_physics(
              "twist strip of 9 columns, hinge driven to theta 20 deg" + blocks, strip,
              testing::hinge_drive({{5, 0}, model::Axis::y}, 20 * degree).on(strip), rubber_blocks()),
          equilibrium_against_physics("bent sheet, 8 x 8, plates to theta 35 deg" + blocks, sheet,
                                      testing::plates_drive(model::Axis::y, 35 * degree).on(sheet),
                                      rubber_blocks())};
}

}  // namespace kinetix::bench
