#include "targets/helmet/walls_inside.hpp"

#include <gtest/gtest.h>

#include "model/lattice/square/structure.hpp"
#include "tests/targets/meshes.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

/// 3 x 2 cells of 10 mm with walls 4 mm high, flat, round the origin.
struct Sheet {
  model::Structure structure = make_structure(model::rectangle(3, 2), {10, 1, 4});

  /// Its middle plane at height z.
  model::State at(double z) const {
    model::State state = rest_state(structure);
    Vector3d middle = Vector3d::Zero();
    for (const model::Pose& pose : state) middle += pose.p / static_cast<double>(state.size());
    for (model::Pose& pose : state) pose.p += Vector3d(0, 0, z) - middle;
    return state;
  }
};

TEST(WallsInside, OfASheetOnACubeAreAllOrNone) {
  const Sheet sheet;
  const MeshSolid block(testing::cube(50));
  const int corners = 2 * 8 * static_cast<int>(sheet.structure.hinges.size());
  struct Case {
    double z;
    bool is_inside;
    double share, depth;
  };
  for (const auto& [z, is_inside, share, depth] : {Case{60, false, 0, 0},
                                                   {52.1, false, 0, 0},
                                                   {51, true, 0.5, 1},
                                                   {48.5, true, 0.5, 3.5},
                                                   {40, true, 1, 12}}) {
    const WallsInside found = walls_inside(sheet.structure, sheet.at(z), block);
    EXPECT_EQ(found.hinges.size(), is_inside ? sheet.structure.hinges.size() : 0) << z;
    EXPECT_EQ(found.corners, share * corners) << z;
    EXPECT_NEAR(found.depth_mm, depth, 1e-9) << z;
  }
}

TEST(WallsInside, AreSeenBetweenTheirCorners) {
  const Sheet sheet;
  const model::State state = sheet.at(0);
  const Vector3d middle = state[sheet.structure.hinges[4].lower].p +
                          3 * model::edge_direction(sheet.structure.hinges[4].wall.axis);
  TriangleMesh needle;
  testing::add_part(needle, testing::ellipsoid({0.1, 0.1, 40}, 12, 12), middle);
  const WallsInside found = walls_inside(sheet.structure, state, MeshSolid(needle));
  EXPECT_EQ(found.hinges, std::vector<int>{4});
  EXPECT_EQ(found.corners, 0);
  EXPECT_EQ(found.depth_mm, 0);
}

}  // namespace
}  // namespace kinetix::targets
