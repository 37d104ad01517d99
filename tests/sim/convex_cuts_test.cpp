#include "sim/shapes/convex_cuts.hpp"
#include "sim/shapes/cut_quality.hpp"

#include <gtest/gtest.h>

#include "model/base/invalid_input.hpp"
#include "tests/support/strip_solids.hpp"

namespace kinetix::sim {
namespace {

using model::Polyhedron;
using testing::box_solid;
using testing::moved;
using testing::ring;
using testing::strip_solid;
using testing::tube;

/// At least 99.9 % of the solid covered, nothing out by more than a hundredth of its size or 0.1 mm, at most 32 pieces.
std::size_t expect_good_cuts(const Polyhedron& solid, const std::string& name, int samples = 20000) {
  SCOPED_TRACE(name);
  const std::vector<CutPiece> pieces = convex_cuts(solid);
  const CutQuality quality = measured(pieces, solid, samples);
  Eigen::AlignedBox3d box;
  for (const auto& p : solid.points) box.extend(p);
  EXPECT_GE(quality.coverage, 0.999);
  EXPECT_LE(quality.sticks_out_mm, std::max(0.1, 0.01 * box.sizes().maxCoeff()));
  EXPECT_LE(pieces.size(), 32u);
  return pieces.size();
}

/// A prism over a closed curve drawn counter-clockwise, its caps fans about the first corner, which must see all others.
Polyhedron prism_over(const std::vector<Eigen::Vector2d>& outline, double height) {
  Polyhedron solid;
  const int n = static_cast<int>(outline.size());
  for (const double s : {0.0, height})
    for (const auto& p : outline) solid.points.emplace_back(p.x(), p.y(), s);
  std::vector<int> low, high;
  for (int k = 0; k < n; ++k) {
    solid.add_face({k, (k + 1) % n, n + (k + 1) % n, n + k});
    high.push_back(n + k);
    low.push_back((n - k) % n);
  }
  solid.add_face(low);
  solid.add_face(high);
  return solid;
}

TEST(ConvexCuts, LeaveConvexSolidsWhole) {
  EXPECT_EQ(expect_good_cuts(box_solid(-3, 4, 2, 5), "box"), 1u);
  EXPECT_EQ(expect_good_cuts(tube(ring(4, 64, true), {}, 0, 9), "cylinder"), 1u);
}

TEST(ConvexCuts, TakeAnLApartInTwo) {
  const Polyhedron l = prism_over({{2, 2}, {2, 10}, {0, 10}, {0, 0}, {10, 0}, {10, 2}}, 6);
  EXPECT_EQ(expect_good_cuts(l, "L"), 2u);
}

TEST(ConvexCuts, CoverTubesHourglassesAndDovetails) {
  expect_good_cuts(tube(ring(5, 48, true), ring(3, 48, true), 0, 12), "tube");
  expect_good_cuts(tube(ring(3, 24, true), ring(2.2, 24, false), -1, 1), "eye");
  std::vector<double> ms;
  for (int k = 0; k <= 40; ++k) ms.push_back(-5 + 0.25 * k);
  expect_good_cuts(strip_solid(
                       ms, [](double m) { return 0.6 + 0.08 * m * m; }, 8),
                   "hourglass");
  const Polyhedron dovetail = prism_over({{0, 0}, {-3, 4}, {-8, 4}, {-8, -4}, {8, -4}, {8, 4}, {3, 4}}, 10);
  expect_good_cuts(dovetail, "dovetail");
}

TEST(ConvexCuts, CoverAWallWithAWindowHoweverItLies) {
  const std::vector<Eigen::Vector2d> frame{{10, 6}, {-10, 6}, {-10, -6}, {10, -6}},
      window{{4, 3}, {-4, 3}, {-4, -3}, {4, -3}};
  const Polyhedron wall = tube(frame, window, 0, 1.2);
  EXPECT_LE(expect_good_cuts(wall, "window"), 4u);
  const Eigen::Isometry3d lying =
      Eigen::Translation3d(3, 1, -7) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 0.3).normalized());
  EXPECT_LE(expect_good_cuts(moved(wall, lying), "leaning window"), 4u);
}

TEST(ConvexCuts, CoverPartsOfAThousandTriangles) {
  expect_good_cuts(tube(ring(5, 125, true), ring(3, 125, true), 0, 12), "fine tube", 4000);
  expect_good_cuts(tube(ring(30, 125, true), ring(29, 125, true), 0, 40), "thin tube", 4000);
}

/// An eighth of the bore is 0.23 mm deep, a quarter 0.88 mm; watch points are 0.48 mm off.
TEST(ConvexCuts, TakeATubeApartInEighthsWhereverItLies) {
  const Polyhedron solid = tube(ring(5, 48, true), ring(3, 48, true), 0, 12);
  for (const double away : {0.0, 30.0}) {
    const Polyhedron there =
        moved(solid, Eigen::Translation3d(away, -away, 2 * away) *
                         Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 0.3).normalized()));
    const auto pieces = convex_cuts(there, {.tolerance_mm = 0.6});
    EXPECT_EQ(pieces.size(), 8u) << away;
    EXPECT_GE(measured(pieces, there, 20000).coverage, 0.999) << away;
  }
}

/// The slit's walls are at most 0.07 mm apart. That is nearer than watch points are to them, 0.8 of 0.1 mm.
TEST(ConvexCuts, LeaveASolidWholeWithASlitNarrowerThanTheTolerance) {
  const Polyhedron slit =
      prism_over({{5, 2}, {4.965, 10}, {0, 10}, {0, 0}, {10, 0}, {10, 10}, {5.035, 10}}, 6);
  EXPECT_EQ(expect_good_cuts(slit, "slit"), 1u);
}

/// Pieces that cover 3 of 4 mm of a bar, one of them twice, and go on for 1 mm beyond its end.
TEST(CutQuality, IsThatOfPiecesAlongABar) {
  const Polyhedron bar = box_solid(-2, 2, 2, 5);
  const auto piece = [](double from, double to) { return convex_cuts(box_solid(from, to, 2, 5)).front(); };
  const CutQuality quality = measured({piece(-2, 0), piece(1, 3), piece(1, 3)}, bar, 20000);
  EXPECT_NEAR(quality.coverage, 3.0 / 4, 1e-2);
  EXPECT_NEAR(quality.overlap, 2.0 / 4, 1e-2);
  EXPECT_NEAR(quality.sticks_out_mm, 1, 1e-2);
}

TEST(ConvexCuts, LeaveATubeWholeWhoseBoreMayBeFilled) {
  const Polyhedron eye = tube(ring(3, 24, true), ring(1.8, 24, false), -1, 2);
  const FilledBore bore{{0, 0, 0.5}, Eigen::Vector3d::UnitZ(), 1.9, 2};
  EXPECT_EQ(convex_cuts(eye, {.filled = {bore}}).size(), 1u);
  EXPECT_GT(convex_cuts(eye).size(), 4u);
}

TEST(ConvexCuts, AreTheSameAgainAndRefuseNonsense) {
  const Polyhedron solid = tube(ring(5, 32, true), ring(3, 32, true), 0, 12);
  const auto first = convex_cuts(solid), again = convex_cuts(solid);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t k = 0; k < first.size(); ++k) EXPECT_EQ(first[k].corners, again[k].corners);
  EXPECT_THROW(convex_cuts(solid, {.tolerance_mm = std::nan("")}), InvalidInput);
  EXPECT_THROW(convex_cuts(solid, {.max_pieces = 0}), InvalidInput);
}

}  // namespace
}  // namespace kinetix::sim
