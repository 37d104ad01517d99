#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <stop_token>

#include "model/contact/wall_contact.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "optim/fold/fit_fold.hpp"
#include "optim/fold/folded_net.hpp"

namespace kinetix::optim {
namespace {

const model::CellSize small_cell = {10, 0.8, 6};  // mm: edge, thickness and height, as in the README

FoldOptions options(const model::CellSize& size = small_cell) {
  FoldOptions out;
  out.size = size;
  return out;
}

/// Two squares with one crease.
targets::FoldNet pair_of_faces(double angle, targets::Side side = targets::Side::right) {
  return {{{"base", 3, 3}, {"flap", 3, 3}}, {{0, 1, side, angle}}};
}

TEST(FitFold, FoldsACubeWithTwoColumnsACreaseAndNoWallInTheWay) {
  const FoldDesign design = fit_fold(targets::box_goal({4, 4, 4}), options());
  ASSERT_TRUE(design.folds);
  EXPECT_TRUE(design.obstacles.empty());
  EXPECT_THAT(design.attempts.back().columns, ::testing::Each(2));
  for (const double fold : design.folded.error.fold) EXPECT_NEAR(fold, pi / 2, 1e-12);
  EXPECT_LE(design.folded.error.rms, 1e-13);
  const model::Structure& structure = design.folded.structure;
  const model::Classification kind = classify(structure);
  EXPECT_EQ(kind.family, model::Family::F4) << kind.why;
  model::ThetaRangeOptions limit;
  limit.limit = design.folded.theta;
  EXPECT_FALSE(theta_range(structure, exact_motion(structure, kind), limit).positive.touches);
}

TEST(FitFold, SaysThatOneColumnACreaseCannotFoldACube) {
  const FoldDesign design = fit_fold(targets::box_goal({4, 4, 4}, {}, 1), options());
  EXPECT_FALSE(design.folds);
  ASSERT_EQ(design.obstacles.size(), 1u);
  EXPECT_THAT(design.obstacles[0], ::testing::HasSubstr("walls of"));
}

TEST(FitFold, SaysThatItWasStoppedBeforeOneFolds) {
  std::stop_source stop;
  FoldOptions stoppable = options();
  stoppable.stop = stop.get_token();
  EXPECT_FALSE(fit_fold(targets::box_goal({4, 4, 4}), stoppable).stopped);
  EXPECT_FALSE(fit_fold(targets::box_goal({4, 4, 4}, {}, 1), stoppable).stopped) << "nothing is left to try";
  stop.request_stop();
  const FoldDesign design = fit_fold(targets::box_goal({4, 4, 4}), stoppable);
  EXPECT_FALSE(design.folds);
  EXPECT_TRUE(design.stopped);
  EXPECT_THAT(design.obstacles, ::testing::ElementsAre("the search was stopped"))
      << "a goal without any is met";
}

TEST(FitFold, SaysThatTiltsAreTooSmall) {
  FoldOptions gentle = options();
  gentle.tilt = 10 * radians_per_degree;
  const FoldDesign design = fit_fold(targets::box_goal({2, 2, 2}, {}, 2), gentle);
  EXPECT_FALSE(design.folds);
  EXPECT_THAT(design.obstacles, ::testing::ElementsAre(::testing::HasSubstr("more columns")));
  EXPECT_LT(design.folded.error.fold[0], pi / 2);
}

TEST(FitFold, TakesNoTiltsThatMakeWallsTouchWhenFlat) {
  const model::CellSize tall = {10, 1, 15};
  const FoldDesign design = fit_fold(targets::box_goal({2, 2, 2}), options(tall));
  EXPECT_FALSE(design.folds);
  EXPECT_THAT(design.obstacles, ::testing::Contains(::testing::HasSubstr("when flat")));
}

TEST(FitFold, SpreadsASteeperFoldOverMoreColumns) {
  const FoldDesign design = fit_fold(net_goal(pair_of_faces(150 * radians_per_degree)), options());
  ASSERT_TRUE(design.folds);
  EXPECT_GE(design.folded.layout.creases[0].columns(), 3);
  EXPECT_NEAR(design.folded.error.fold[0], 150 * radians_per_degree, 1e-12);
}

TEST(FitFold, FoldsToTheAskedSideOnEverySideOfAFace) {
  for (const targets::Side side :
       {targets::Side::left, targets::Side::right, targets::Side::bottom, targets::Side::top})
    for (const double angle : {-50.0, 70.0}) {
      const FoldDesign design =
          fit_fold(net_goal(pair_of_faces(angle * radians_per_degree, side)), options());
      ASSERT_TRUE(design.folds) << to_string(side);
      EXPECT_NEAR(design.folded.error.fold[0], angle * radians_per_degree, 1e-12);
      EXPECT_LE(design.folded.error.rms, 1e-13);
      const model::State state = fold_net(design.folded.tree, design.folded.structure, design.folded.theta);
      const double height = state[*design.folded.structure.body_at({design.folded.layout.faces[1].low.i,
                                                                    design.folded.layout.faces[1].low.j})]
                                .p.z();
      EXPECT_GT(height * angle, 0) << "positive folds towards +z";
    }
}

TEST(FitFold, LaysAFlatCreaseFlat) {
  const FoldDesign design = fit_fold(net_goal(pair_of_faces(0)), options());
  ASSERT_TRUE(design.folds);
  EXPECT_EQ(design.folded.layout.creases[0].columns(), 1);
  EXPECT_EQ(design.folded.tilt[0], 0);
}

/// Two flaps fold to the same place over one face.
targets::FoldNet two_lids() {
  return {{{"base", 4, 4}, {"left", 4, 4}, {"right", 4, 4}},
          {{0, 1, targets::Side::left, pi * 8 / 9, 0, 4}, {0, 2, targets::Side::right, pi * 8 / 9, 0, 4}}};
}

TEST(FitFold, SaysWhichFacesAreInEachOthersWay) {
  const FoldDesign design = fit_fold(net_goal(two_lids()), options({10, 0.8, 3}));
  EXPECT_FALSE(design.folds);
  ASSERT_EQ(design.obstacles.size(), 1u);
  EXPECT_THAT(design.obstacles[0],
              ::testing::AllOf(::testing::HasSubstr("`left`"), ::testing::HasSubstr("`right`")));
}

TEST(FaceCrossing, IsFoundBeforeWallsOverlap) {
  const FoldedNet folded =
      fold_to(two_lids(), {4, 4}, 30 * radians_per_degree, {10, 0.8, 3}, 60 * radians_per_degree);
  const auto crossing = first_face_crossing(folded);
  ASSERT_TRUE(crossing.has_value());
  EXPECT_EQ(crossing->first, 1);
  EXPECT_EQ(crossing->second, 2);
  const auto limit = theta_range(folded.structure, exact_motion(folded.structure)).positive;
  EXPECT_TRUE(limit.touches);
  EXPECT_LE(crossing->theta, limit.theta);
  EXPECT_GE(crossing->theta, limit.theta - 2 * radians_per_degree);
}

TEST(FaceCrossing, FindsNoneInAnyUnfoldingOfACube) {
  const targets::FoldGoal cube = targets::box_goal({2, 2, 2}, {}, 2);
  for (const targets::FoldNet& net : cube.nets)
    EXPECT_FALSE(first_face_crossing(
        fold_to(net, std::vector<int>(5, 2), 25 * radians_per_degree, small_cell, 60 * radians_per_degree)));
}

class Solids : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Fit, Solids, ::testing::Range(0, static_cast<int>(targets::solid_names().size())),
                         [](const auto& run) { return targets::solid_names()[run.param]; });

TEST_P(Solids, FoldWithNoWallInTheWay) {
  const SolidDesign design = fit_solid(targets::named_solid(GetParam()), 2, 0, {});
  ASSERT_TRUE(design.folds);
  for (std::size_t c = 0; c < design.net.creases.size(); ++c) {
    EXPECT_NEAR(to_degrees(design.error.fold[c] - design.net.creases[c].angle), 0, 1e-6);
    EXPECT_LE(design.tilt[c], FoldOptions{}.tilt + 1e-12);
  }
  EXPECT_LE(design.error.rms, 1e-9);
  const auto limit =
      theta_range(design.net.structure, exact_motion(design.net.structure), {.limit = design.theta}).positive;
  EXPECT_FALSE(limit.touches);
}

}  // namespace
}  // namespace kinetix::optim
