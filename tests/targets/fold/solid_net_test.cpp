#include "targets/fold/solid_net.hpp"

#include <gtest/gtest.h>

#include "model/closure/mobility.hpp"
#include "model/lattice/planar/planar_motion.hpp"

namespace kinetix::targets {
namespace {

TEST(Solid, HasTheFacesAndEdgesOfItsNameAndEulersFormula) {
  const std::size_t faces[] = {4, 8, 20, 12, 5, 5}, edges[] = {6, 12, 30, 30, 9, 8};
  for (int k = 0; k < static_cast<int>(solid_names().size()); ++k) {
    const Solid solid = named_solid(k);
    EXPECT_EQ(solid.faces.size(), faces[k]) << solid_names()[k];
    EXPECT_EQ(edges_of(solid).size(), edges[k]) << solid_names()[k];
    EXPECT_EQ(solid.corners.size() + solid.faces.size(), edges[k] + 2) << solid_names()[k];
    for (const auto& face : solid.faces)
      for (std::size_t c = 0; c < face.size(); ++c)
        EXPECT_NEAR((solid.corners[face[c]] - solid.corners[face[(c + 1) % face.size()]]).norm(), 1, 1e-12);
  }
}

// Known angles inside: acos(1/3), acos(-1/3), acos(-sqrt(5)/3), acos(-1/sqrt(5)).
TEST(Solid, TurnsItsFacesByTheKnownAngles) {
  const double inside[] = {std::acos(1 / 3.0), std::acos(-1 / 3.0), std::acos(-std::sqrt(5.0) / 3),
                           std::acos(-1 / std::sqrt(5.0))};
  for (int k = 0; k < 4; ++k)
    for (const SolidEdge& edge : edges_of(named_solid(k))) EXPECT_NEAR(edge.turn, pi - inside[k], 1e-12);
}

// Creases have three directions that do not meet. At the theta for which the hinges were tilted, all faces are where
// the closed solid has them. Hinges are closed at every theta.
TEST(SolidNet, FoldsExactlyToItsSolid) {
  for (int k = 0; k < static_cast<int>(solid_names().size()); ++k)
    for (const int columns : {1, 2, 3}) {
      SCOPED_TRACE(solid_names()[k] + ", columns: " + std::to_string(columns));
      SolidNet net = lay_out(named_solid(k), 2, columns, {});
      EXPECT_EQ(net.creases.size() + 1, net.faces.size());
      fold_solid(net, 0.6);
      const model::ExactMotion motion = exact_motion(net.structure);
      ASSERT_TRUE(motion) << motion.why;
      for (const double theta : {0.1, 0.6, 1.1}) {
        EXPECT_LE(hinge_gaps(net.structure, motion.at(theta)).max, 1e-12);
        EXPECT_LE(hinge_gaps(net.structure, motion.at(theta)).axis_max, 1e-12);
      }
      const FoldError error = solid_error(net, motion.at(0.6), 0.6);
      for (std::size_t c = 0; c < net.creases.size(); ++c)
        EXPECT_NEAR(to_degrees(error.fold[c] - net.creases[c].angle), 0, 1e-9);
      EXPECT_LE(error.rms, 1e-12);
      EXPECT_GE(solid_error(net, motion.at(0.5), 0.5).rms, 1e-3) << "not by chance";
    }
}

TEST(SolidNet, HasOneFreedom) {
  for (int k = 0; k < static_cast<int>(solid_names().size()); ++k) {
    SolidNet net = lay_out(named_solid(k), 2, 1, {});
    fold_solid(net, 0.6);
    EXPECT_EQ(null_space(net.structure, exact_motion(net.structure).at(0.4)).dofs(), 1) << solid_names()[k];
  }
}

}  // namespace
}  // namespace kinetix::targets
