#include "model/lattice/square/numbering.hpp"

#include <gtest/gtest.h>

#include "model/base/angle.hpp"
#include "model/hinge/crease_law.hpp"
#include "model/lattice/square/cell_rectangle.hpp"

namespace kinetix::model {
namespace {

TEST(Numbering, IsThatOfASheetsBodies) {
  const int columns = 5, rows = 3;
  const Structure sheet = make_sheet(columns, rows, {});
  EXPECT_EQ(lattice_bodies(columns, rows), sheet.bodies.size());
  EXPECT_EQ(vertex_columns(sheet.bodies.size(), rows), columns + 1);
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j) EXPECT_EQ(lattice_body({i, j}, rows), sheet.body_at({i, j}));
  for (int i = 0; i <= columns; ++i) EXPECT_EQ(column_sign(i), (Vertex{i, 0}.sense()));
}

TEST(Numbering, LinesOfARectangleEndOnItsRim) {
  const Structure sheet = make_sheet(5, 4, {});
  const CellRectangle part{{1, 1}, 3, 2};
  const std::vector<int> bodies = bodies_of(part, sheet);
  for (const Axis axis : {Axis::x, Axis::y}) {
    const auto ends = line_ends(part, axis);
    EXPECT_EQ(static_cast<int>(ends.size()), (axis == Axis::x ? part.height : part.width) + 1);
    for (const auto& [first, last] : ends) {
      EXPECT_EQ(row_along(axis, sheet.bodies[bodies[first]]), 1);
      EXPECT_EQ(row_along(axis, sheet.bodies[bodies[last]]), 1 + part.extent(axis));
    }
  }
}

TEST(CreaseLaw, IsSolvedForTiltAndForTheta) {
  for (const double turn : {0.2, 1.0, 1.5})
    for (const double theta : {0.3, 0.9}) {
      const double tilt = tilt_of_turn(turn, theta);
      EXPECT_NEAR(crease_turn(tilt, theta), turn, 1e-14);
      EXPECT_NEAR(theta_of_turn(turn, tilt), theta, 1e-14);
    }
  EXPECT_EQ(theta_of_turn(1.5, 0.1), std::asin(1.0)) << "a tilt that never turns as far";
}

}  // namespace
}  // namespace kinetix::model
