#include "optim/display/driven_hinge.hpp"

#include <gtest/gtest.h>

#include "model/lattice/square/family/planar_sheet.hpp"
#include "model/lattice/square/structure.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;

Vector2d middle_of(const model::PlanarStructure& panel, int hinge) {
  const auto [from, to] = panel.graph.edges[hinge];
  return (panel.graph.vertices[from] + panel.graph.vertices[to]) / 2;
}

model::Redrawing none(const model::PlanarStructure& panel) {
  return model::Redrawing(panel.graph.vertices.size(), Vector2d::Zero());
}

TEST(DrivenHinge, IsTheNearestToTheMiddleWhereNoWallIsScaled) {
  const model::PlanarStructure panel = planar_structure(model::make_sheet(6, 8, {}));
  const Vector2d middle = middle_of(panel, middle_hinge(panel, none(panel)));
  EXPECT_DOUBLE_EQ((middle - Vector2d(3, 4)).norm(), 0.5);
}

TEST(DrivenHinge, HasTheLeastOffsetOfTheMiddleHalf) {
  const model::PlanarStructure panel = planar_structure(model::make_sheet(8, 8, {}));
  model::Redrawing y = none(panel);
  // All walls change equally. Below, one vertex off the middle moves by as much as one of its walls would.
  for (std::size_t v = 0; v < y.size(); ++v) {
    const Vector2d& x = panel.graph.vertices[v];
    y[v] = 0.1 * Vector2d(-x.y(), x.x());
  }
  const int plain = middle_hinge(panel, y);
  EXPECT_DOUBLE_EQ((middle_of(panel, plain) - Vector2d(4, 4)).norm(), 0.5);
  const auto at = [&](double i, double j) {
    for (int v = 0; v < static_cast<int>(y.size()); ++v)
      if (panel.graph.vertices[v] == Vector2d(i, j)) return v;
    return -1;
  };
  y[at(3, 5)].x() -= 0.1;  // the wall from (3, 5) to (3, 6) keeps to its midline
  const int found = middle_hinge(panel, y);
  EXPECT_NEAR(change_of(panel, y, found).o, 0, 1e-15);
  EXPECT_LE((middle_of(panel, found) - Vector2d(4, 4)).cwiseAbs().maxCoeff(), 2);
}

TEST(DrivenHinge, TurnsByTwiceTheta) {
  model::PlanarStructure panel = planar_structure(model::make_sheet(4, 4, {}));
  const model::Redrawing y = none(panel);
  for (const double theta : {0.3, -0.5})
    for (int hinge = 0; hinge < static_cast<int>(panel.hinges.size()); ++hinge) {
      const model::HingeTurn turn = turn_to(panel, hinge, theta);
      EXPECT_NEAR(turn.angle, hinge_turn(panel, fold(panel, y, theta), hinge), 1e-14);
      EXPECT_NEAR(std::abs(turn.angle), 2 * std::abs(theta), 1e-15);
    }
}

}  // namespace
}  // namespace kinetix::optim
