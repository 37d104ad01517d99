#include "optim/fold/fit_box.hpp"

#include <gtest/gtest.h>

#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

BoxOptions box(const std::array<double, 3>& mm) {
  BoxOptions out;
  out.required_mm = mm;
  out.size = [](double edge_mm) { return model::CellSize{edge_mm, 0.08 * edge_mm, 0.6 * edge_mm}; };
  return out;
}

TEST(FitBox, ComesWithinTwoPerCentOfBoxesOfManyProportions) {
  for (const auto& mm :
       {std::array{120.0, 80.0, 40.0}, {57.0, 57.0, 57.0}, {97.0, 61.0, 23.0}, {30.0, 90.0, 45.0}}) {
    const BoxInCells found = fit_box(box(mm));
    EXPECT_LE(size_miss(found.folded_mm, mm), 0.02) << mm[0];
  }
}

TEST(FitBox, ACubeHasItsSizeAsTheSearchFoldsIt) {
  const BoxOptions asked = box({50, 50, 50});
  const BoxInCells found = fit_box(asked);
  FoldOptions fold;
  fold.size = asked.size(found.edge_mm);
  const FoldDesign design = fit_fold(targets::box_goal(found.edges), fold);
  ASSERT_TRUE(design.folds);
  const auto mm = folded_box(found.edges, {}, found.edge_mm, design.folded.theta,
                             design.folded.layout.creases[0].columns());
  for (const double edge : mm) EXPECT_NEAR(edge, 50, 1e-6);
}

TEST(FitBox, KeepsACellEdgeThatIsGiven) {
  BoxOptions asked = box({120, 80, 40});
  asked.edge_mm = 10;
  const BoxInCells found = fit_box(asked);
  EXPECT_EQ(found.edge_mm, 10);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found.folded_mm[k], asked.required_mm[k], 5) << "half a cell";
}

/// A given edge leads to the box that the search found for it. Walls of a given size close cells at a theta that
/// depends on the edge.
TEST(FitBox, OtherCellsGiveABoxItsSizeWhenTheyAreGiven) {
  BoxOptions asked = box({83, 47, 29});
  asked.edge_mm = 8;
  for (const bool walls_follow : {true, false}) {
    if (!walls_follow) asked.size = [](double edge_mm) { return model::CellSize{edge_mm, 0.5, 3}; };
    const auto better = other_cells(asked, 0.02);
    ASSERT_TRUE(better) << walls_follow;
    BoxOptions given = asked;
    given.edge_mm = better->edge_mm;
    const BoxInCells followed = fit_box(given);
    EXPECT_EQ(followed.edges, better->edges);
    EXPECT_LE(size_miss(followed.folded_mm, asked.required_mm), 0.025) << "with the theta of a small box";
    FoldOptions fold;
    fold.size = asked.size(better->edge_mm);
    const FoldDesign design = fit_fold(targets::box_goal(better->edges), fold);
    ASSERT_TRUE(design.folds);
    EXPECT_LE(size_miss(folded_box(better->edges, {}, better->edge_mm, design.folded.theta,
                                   design.folded.layout.creases[0].columns()),
                        asked.required_mm),
              0.02);
  }
}

TEST(FitBox, HasNoOtherCellsForASizeThatNoneComesNear) { EXPECT_FALSE(other_cells(box({83, 47, 29}), 1e-6)); }

TEST(FitBox, AFoldedEdgeIsItsFaceInPitchesAndTwoInsets) {
  const double pitch = 10 * std::cos(0.5);
  EXPECT_NEAR(folded_box({4, 2, 1}, {}, 10, 0.5, 1)[0], 5 * pitch, 1e-12)
      << "one column: half a pitch at either end";
  EXPECT_NEAR(folded_box({4, 2, 1}, {}, 10, 0.5, 2)[2], (1 + 1 / std::tan(pi / 8)) * pitch, 1e-12);
}

TEST(FitBox, RefusesABoxOfTooUnlikeEdges) { EXPECT_THROW(fit_box(box({1, 500, 30})), InvalidInput); }

}  // namespace
}  // namespace kinetix::optim
