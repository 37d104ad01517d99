#include "model/lattice/origami/march.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/lattice/origami/quad_mesh.hpp"
#include "tests/support/bad_input.hpp"

namespace kinetix::model {
namespace {

using ::testing::HasSubstr;

TEST(March, GivesTheMiuraSheetItsParallelograms) {
  const double angle = 1.1;
  const MarchedMesh<double> miura_mesh = march(miura(5, 4, angle, 2));
  validate(miura_mesh.mesh);
  for (int j = 1; j < 4; ++j)
    for (int i = 1; i < 5; ++i) {
      const Eigen::Vector4d sector = sectors(miura_mesh.mesh, i, j);
      EXPECT_NEAR(std::abs(sector[0] - pi / 2), pi / 2 - angle, 1e-12);
    }
  EXPECT_NEAR(mean_edge(miura_mesh.mesh), 1, 1e-12);
}

TEST(March, OfTheMiuraSheetFoldsAsItsClosedForm) {
  // Its crease lines keep to two planes a distance 2 h apart: a facet's slope follows from its fold angles.
  const MarchedMesh<double> sheet = march(miura(4, 4, 1.0, 1.5));
  const FoldedMesh folded = fold_facets(sheet.mesh, std::sin(0.5));
  const Eigen::Vector3d across =
      folded.vertices[sheet.mesh.vertex(3, 1)] - folded.vertices[sheet.mesh.vertex(1, 1)];
  const Eigen::Vector3d along =
      folded.vertices[sheet.mesh.vertex(1, 3)] - folded.vertices[sheet.mesh.vertex(1, 1)];
  const Eigen::Vector3d normal = across.cross(along).normalized();
  const double height =
      normal.dot(folded.vertices[sheet.mesh.vertex(2, 1)] - folded.vertices[sheet.mesh.vertex(1, 1)]);
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i) {
      const double z =
          normal.dot(folded.vertices[sheet.mesh.vertex(i, j)] - folded.vertices[sheet.mesh.vertex(1, 1)]);
      EXPECT_NEAR(z, i % 2 == 1 ? 0 : height, 1e-12);
    }
  EXPECT_GT(std::abs(height), 0.3);
}

TEST(March, TellsAMeshThatIsNotFlatFoldable) {
  QuadMesh mesh = march(miura(4, 4, 1.0, 1.5)).mesh;
  mesh.at(2, 2).x() += 0.01;
  EXPECT_THROW(validate(mesh), InvalidInput);
  EXPECT_GT(fold_gap(mesh, 0.5), 1e-3);
}

TEST(QuadMesh, SaysWhatIsWrongWithIt) {
  const auto refused = [](const QuadMesh& bad) { return testing::refusal([&] { validate(bad); }); };
  const QuadMesh good = march(miura(3, 3, 1.0, 1.5)).mesh;
  validate(good);
  QuadMesh mesh = good;
  mesh.level.pop_back();
  EXPECT_THAT(refused(mesh), HasSubstr("one multiplier per crease"));
  mesh = good;
  mesh.at(0, 0).x() = std::nan("");
  EXPECT_THAT(refused(mesh), HasSubstr("facet [0, 0] has corners that are not finite"));
  mesh = good;
  mesh.at(3, 3) = mesh.at(2, 2) - (mesh.at(3, 3) - mesh.at(2, 2));
  EXPECT_THAT(refused(mesh), HasSubstr("facet [2, 2] is reversed or not convex"));
  mesh = good;
  mesh.level[mesh.level_crease(1, 1)] *= 1.1;
  EXPECT_THAT(refused(mesh), HasSubstr("fold multipliers do not close round vertex [1, 1]"));
}

}  // namespace
}  // namespace kinetix::model
