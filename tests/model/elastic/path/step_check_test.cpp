#include "model/elastic/path/step_check.hpp"

#include <gtest/gtest.h>

#include "model/lattice/planar/planar_drive.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/planar_graphs.hpp"

namespace kinetix::model {
namespace {

/// Two of its walls stand tip to tip on the way, and a snap would take one across the other.
TEST(EquilibriumPath, NeverHasWallsThatCrossEachOther) {
  CellSize size;
  size.thickness_mm = 0.4;
  const PlanarStructure panel = make_planar_structure({&octagon_lattice, lattice_cells(3, 3), 0, true}, size);
  const DrivenLinkage driven{panel, plate_drive(panel, Axis::y, 0.1339746, 1), exact_motion(panel)};
  ContactModel walls(panel, true);
  const State flat = rest_state(panel);
  int steps = 0;
  trace_equilibrium(driven, {.k_turn = 10}, {}, [&](const EquilibriumStep& step, const State& state) {
    EXPECT_FALSE(walls.newly_cross(flat, state)) << "theta " << step.theta;
    ++steps;
  });
  EXPECT_GE(steps, 10);
}

}  // namespace
}  // namespace kinetix::model
