#include <gtest/gtest.h>

#include "model/closure/mobility.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/planar/closed_boundary.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "tests/support/creased.hpp"
#include "tests/support/planar_graphs.hpp"

namespace kinetix::model {
namespace {

using testing::Creased;
using testing::creased;
using testing::fold_angle;
using testing::folded;

struct NamedLattice {
  const char* name;
  const PlanarLattice& lattice;
};

const NamedLattice lattices[] = {
    {"honeycomb", honeycomb_lattice}, {"bricks", brick_lattice}, {"octagons", octagon_lattice}};

TEST(Crease, FoldsAnyLatticeByTheLawOfSquares) {
  for (const auto& [name, lattice] : lattices) {
    const Creased c = creased(lattice_graph(lattice, 5, 4));
    ASSERT_GE(c.hinges.size(), 5u) << name;
    const Linkage linkage = c.structure;
    for (const double theta : {0.1, 0.4, 0.9}) {
      const double rho = testing::fold_angle(theta);
      const HingeGaps down = hinge_gaps(linkage, folded(c, theta, rho)),
                      up = hinge_gaps(linkage, folded(c, theta, -rho));
      EXPECT_LE(std::min(down.max, up.max), 1e-14) << name;
      EXPECT_LE(std::min(down.axis_max, up.axis_max), 1e-14) << name;
      EXPECT_GE(hinge_gaps(linkage, folded(c, theta, 0)).axis_max, 0.05) << name << ": it does not stay flat";
    }
  }
}

// With boundaries closed as for displays, one degree of freedom remains, and springs follow it. Further on, walls of
// bricks and octagons touch.
TEST(Crease, IsWhatTheElasticModelComesTo) {
  constexpr double theta = 0.2;
  for (const auto& [name, lattice] : lattices) {
    const Creased c = creased(closed_boundary(lattice_graph(lattice, 3, 3)));
    ASSERT_GE(c.hinges.size(), 4u) << name;
    const State down = folded(c, theta, testing::fold_angle(theta)),
                up = folded(c, theta, -testing::fold_angle(theta));
    const State& exact = hinge_gaps(c.structure, down).max < hinge_gaps(c.structure, up).max ? down : up;
    EXPECT_LE(hinge_gaps(c.structure, exact).max, 1e-14) << name;
    EXPECT_EQ(null_space(c.structure, exact).dofs(), 1) << name;
    const LinkageDrive drive = drive_to(c.structure, theta);
    const EquilibriumPath path = trace_equilibrium({c.structure, drive, exact_motion(c.structure)}, {}, {});
    ASSERT_EQ(path.stop, EquilibriumPath::Stop::reached) << name;
    EXPECT_LE(aligned_distance(c.structure, path.state, exact).rms, 1e-2) << name;
  }
}

}  // namespace
}  // namespace kinetix::model
