#include <gtest/gtest.h>

#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "sim/physics_run.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

/// Plates that push the vertices of their rows and never pull them.
namespace kinetix::sim {
namespace {

using namespace testing;
using Status = PhysicsResult::Status;

struct Pressed {
  model::Structure sheet;
  model::LinkageDrive drive;
  PhysicsResult run;
  model::EquilibriumPath path;
};

Pressed pressed(const model::Structure& sheet, const model::Axis axis, double theta, bool press) {
  Pressed out{sheet, drive_on(sheet, plates_drive(axis, theta)), {}, {}};
  out.drive.press = press;
  PhysicsOptions options;
  options.elastic = relative(model::Elasticity{}, sheet.size.edge_mm);
  options.planar = true;
  options.contact = false;
  out.run = run_compression(sheet, out.drive, options);
  out.path = trace_equilibrium({sheet, out.drive, exact_motion(sheet)}, {}, without_contact());
  return out;
}

/// Returns how far a body of a row is from its plate, towards the other one, cell edges.
double parted(const Pressed& p, int side, int body) {
  const int axis = p.drive.axis == model::Axis::x ? 0 : 1;
  const auto place = [&](int k) { return p.sheet.rest_position(p.drive.gripped[k].front())[axis]; };
  const double middle = (place(0) + place(1)) / 2;
  const double plate = middle + (place(side) - middle) * (1 - p.drive.compression);
  return (side == 0 ? 1 : -1) * (p.run.state[body].p[axis] - plate) / p.sheet.size.edge_mm;
}

// The plates' joints in the engine yield by about 1e-5 cell edges under the forces of this panel, which are kN.
constexpr double yields = 1e-4;

// The paper's rule, which strains its hinges: gripped, some bodies of the rows are pulled.
TEST(Press, LetsBodiesLeaveTheirPlateAndAgreesWithTheEquilibrium) {
  const model::Structure panel = letter_panel(0.15, 6);
  const Pressed found = pressed(panel, model::Axis::y, 20 * radians_per_degree, true);
  ASSERT_EQ(found.run.status, Status::settled) << found.run.why;
  ASSERT_EQ(found.path.stop, model::EquilibriumPath::Stop::reached) << found.path.why;
  EXPECT_LE(aligned_distance(panel, found.run.state, found.path.state).max, yields);

  int away = 0, rest = 0;
  for (const int side : {0, 1})
    for (const int body : found.drive.gripped[side]) {
      const double by = parted(found, side, body);
      EXPECT_GE(by, -yields) << "side " << side << ", body " << body;
      ++(by > 1e-3 ? away : rest);
    }
  EXPECT_GE(away, 1);
  EXPECT_GE(rest, 4);
  EXPECT_LE(found.run.drive_gap, yields);

  const Pressed gripped = pressed(panel, model::Axis::y, 20 * radians_per_degree, false);
  EXPECT_GT(aligned_distance(panel, found.run.state, gripped.run.state).max, 1e-3);
}

TEST(Press, FoldsABasicSheetAsPlatesThatGripDo) {
  const model::Structure sheet = model::make_sheet(3, 4, {});
  for (const double theta : {25 * radians_per_degree, -25 * radians_per_degree})
    for (const model::Axis axis : {model::Axis::x, model::Axis::y}) {
      const Pressed found = pressed(sheet, axis, theta, true);
      EXPECT_EQ(found.run.status, Status::settled) << found.run.why;
      EXPECT_LE(from_closed_form(sheet, found.run.state, theta), 1e-4);
      EXPECT_LE(aligned_distance(sheet, found.run.state, found.path.state).max, 1e-6);
    }
}

TEST(Press, TakesElasticHinges) {
  const model::Structure sheet = model::make_sheet(2, 2, {});
  model::LinkageDrive drive = drive_on(sheet, plates_drive(model::Axis::y, 0.3));
  drive.press = true;
  EXPECT_THAT(refusal([&] { run_compression(sheet, drive); }), ::testing::HasSubstr("needs elastic hinges"));
}

}  // namespace
}  // namespace kinetix::sim
