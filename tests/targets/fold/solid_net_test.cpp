#include "targets/fold/solid_net.hpp"

#include <gmock/gmock.h>

#include "model/closure/mobility.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "tests/support/bad_input.hpp"

namespace kinetix::targets {
namespace {

TEST(Solid, HasTheFacesAndEdgesOfItsNameAndEulersFormula) {
  const std::size_t faces[] = {4, 8, 20, 12, 5, 5, 6}, edges[] = {6, 12, 30, 30, 9, 8, 12};
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

/// Returns a box with edges a, b and c as triangles, in cm, its corners a little off.
TriangleMesh box_mesh(double a, double b, double c) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back(a * (k & 1) + 1e-5 * k, b * (k >> 1 & 1), c * (k >> 2) - 1e-5 * k);
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

TEST(SolidNet, OfUnequalEdgesFoldsExactlyToItsSolid) {
  const Solid box = solid_of(box_mesh(3, 4.5, 7));
  EXPECT_EQ(box.faces.size(), 6u);
  for (const int columns : {1, 2}) {
    SolidNet net = lay_out(box, 2, columns, {});
    fold_solid(net, 0.6);
    const model::ExactMotion motion = exact_motion(net.structure);
    ASSERT_TRUE(motion) << motion.why;
    EXPECT_LE(hinge_gaps(net.structure, motion.at(0.6)).max, 1e-9);
    EXPECT_LE(solid_error(net, motion.at(0.6), 0.6).rms, 1e-3);
  }
}

TEST(Solid, OfAMeshIsClosedAndConvex) {
  TriangleMesh open = box_mesh(3, 3, 3);
  open.triangles.resize(10);
  EXPECT_THAT(testing::refusal([&] { solid_of(open); }), ::testing::HasSubstr("open or not convex"));
  TriangleMesh dented = box_mesh(3, 3, 3);
  dented.vertices.emplace_back(1.5, 1.5, 2);
  EXPECT_THAT(testing::refusal([&] { solid_of(dented); }),
              ::testing::HasSubstr("a corner lies inside its hull"));
  EXPECT_THAT(testing::refusal([&] { solid_of(box_mesh(1, 1, 5)); }),
              ::testing::HasSubstr("at most 4 is allowed"));
  EXPECT_THAT(testing::refusal([&] { solid_of({}); }), ::testing::HasSubstr("fewer than 4"));
  TriangleMesh divided = box_mesh(3, 3, 3);
  divided.vertices.emplace_back(1.5, 0, 0);
  EXPECT_EQ(solid_of(divided).corners.size(), 8u) << "a point within an edge is no corner";
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
