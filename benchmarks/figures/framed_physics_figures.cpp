#include "benchmarks/equilibrium_against_physics.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::bench {
namespace {

/// Soft blocks between the half walls of the scenes, 6 mm high and 1 mm long: along the wall several times as stiff as
/// across it.
model::Elasticity rubber_blocks(double thickness_mm) {
  return elasticity_of(model::ManufacturedHinge{.kind = model::HingeKind::block,
                                                .material = *model::find_material("tango"),
                                                .gap_mm = 1,
                                                .thickness_mm = thickness_mm,
                                                .height_mm = 6});
}

}  // namespace

std::vector<Figure> framed_physics_figures() {
  constexpr double degree = radians_per_degree;
  const model::Structure letter = testing::letter_panel(0.15), strip = testing::twisting_strip(),
                         sheet = testing::alternating(8, 8, testing::twisting_unit, testing::basic_unit);
  // Plates buckle the sheet of thicker blocks in several ways, all of them stable: springs in its hinges fold it in one.
  const model::Elasticity thick = rubber_blocks(0.8), thin = rubber_blocks(0.4);
  return {equilibrium_against_physics(
              "letter T, 10 x 10, k = 0.15, 16 % compression, rubber blocks of 1 x 0.8 mm", letter,
              drive_on(letter, testing::plates_drive(model::Axis::y, std::acos(0.84))), thick),
          equilibrium_against_physics(
              "twist strip of 9 columns, hinge driven to theta 20 deg, rubber blocks of 1 x 0.8 mm", strip,
              drive_on(strip, testing::hinge_drive(strip, {{5, 0}, model::Axis::y}, 20 * degree)), thick),
          equilibrium_against_physics(
              "bent sheet, 8 x 8, plates to theta 35 deg, rubber blocks of 1 x 0.4 mm", sheet,
              drive_on(sheet, testing::plates_drive(model::Axis::y, 35 * degree)), thin),
          equilibrium_against_physics(
              "the same, shape memory of 20 N mm/rad in every hinge to 35 deg, rubber blocks of 1 x 0.8 mm",
              sheet, shape_memory_drive(sheet, {}, 20, 35 * degree), thick)};
}

}  // namespace kinetix::bench
