#include <gmock/gmock.h>
#include <cmath>

#include "targets/fold/fold_error.hpp"
#include "targets/fold/fold_goal.hpp"

namespace kinetix::targets {
namespace {

std::vector<int> one_column(const FoldNet& net) { return std::vector<int>(net.creases.size(), 1); }

double from_plane(double x, double low, double high) {
  return std::min(std::abs(x - low), std::abs(x - high));
}

TEST(BoxUnfoldings, FindsTheElevenNetsOfACube) { EXPECT_EQ(box_unfoldings({4, 4, 4}).size(), 11u); }

TEST(BoxUnfoldings, FindsTheFiftyFourNetsOfABoxWithThreeDifferentEdges) {
  EXPECT_EQ(box_unfoldings({3, 8, 20}).size(), 54u);
}

TEST(BoxUnfoldings, FindsTheEightNetsOfAnOpenCube) { EXPECT_EQ(box_unfoldings({4, 4, 4}, 1).size(), 8u); }

TEST(BoxUnfoldings, PutsTheFlattestTreeFirst) {
  const FoldNet tray = box_unfoldings({3, 2, 1}, 1).front();
  ASSERT_EQ(tray.creases.size(), 4u);
  for (const FoldCrease& crease : tray.creases) EXPECT_EQ(tray.faces[crease.first].name, "bottom");
}

TEST(BoxUnfoldings, LieFlatWithoutTouching) {
  for (const auto& edges : {std::array{4, 4, 4}, std::array{5, 3, 1}, std::array{1, 1, 1}})
    for (const FoldNet& net : box_unfoldings(edges)) {
      validate(net);
      EXPECT_NO_THROW(lay_out(net, one_column(net)));
    }
}

/// One column replaces an edge half a pitch beyond the vertices, so a box of 5 x 3 x 2 cells a face has edges
/// of 6 x 4 x 3 pitches, and every face's vertices lie on its sides.
TEST(BoxUnfoldings, FoldToTheBox) {
  for (const FoldNet& net : box_unfoldings({5, 3, 2})) {
    const NetLayout layout = lay_out(net, one_column(net));
    const auto faces = ideal_faces(net, layout, 1.0);
    const Eigen::Vector3d low = faces[0].col(0) - Eigen::Vector3d(0.5, 0.5, 0), size(6, 4, 3);
    for (const auto& face : faces) {
      Eigen::Vector3d away = Eigen::Vector3d::Zero();
      for (const auto& p : face.colwise())
        for (int k = 0; k < 3; ++k) away[k] = std::max(away[k], from_plane(p[k], low[k], low[k] + size[k]));
      EXPECT_LT(away.minCoeff(), 1e-12);
      EXPECT_GT((face.rowwise().minCoeff() - low).minCoeff(), -1e-12);
      EXPECT_LT((face.rowwise().maxCoeff() - low - size).maxCoeff(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace kinetix::targets
