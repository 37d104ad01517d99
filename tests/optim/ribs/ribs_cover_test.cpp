#include "optim/ribs/ribs_cover.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "model/base/geometry.hpp"
#include "model/lattice/square/family/net.hpp"
#include "model/lattice/square/fishbone.hpp"
#include "optim/ribs/fit_ribs.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

constexpr double edge = 10;  // mm, of a cell: distances below it count as near

/// A flat strip along y, its middle on the z axis, and the plane below it.
struct Strip {
  explicit Strip(int rows, double above) : fishbone(model::make_fishbone({rows, {}}, {edge, 1, 2})) {
    state = fold_net(make_net_tree(fishbone.structure, fishbone.middle), fishbone.structure, 0);
    Eigen::AlignedBox3d box;
    for (const model::Pose& pose : state) box.extend(pose.p);
    for (model::Pose& pose : state) pose.p += Vector3d(0, 0, above) - box.center();
  }
  model::Fishbone fishbone;
  model::State state;
};

/// A rectangle in the plane z = 0 as two triangles.
targets::TriangleMesh rectangle(double width, double length) {
  const double x = width / 2, y = length / 2;
  return {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

targets::MeshDistance seen_from_below(const targets::TriangleMesh& mesh) {
  return {mesh, Vector3d(0, 0, -1000)};
}

// The strip is an edge wide, and an edge beside it counts: three edges of the plane's ten.
TEST(RibsCover, OfAPlaneIsTheStripAndAnEdgeOnBothSides) {
  const Strip strip(10, 0);
  const targets::TriangleMesh plane = rectangle(10 * edge, 10 * edge);
  const RibsReach reach(strip.fishbone.structure, strip.state, seen_from_below(plane), 0);
  const RibsCover cover = cover_by(reach, plane);
  EXPECT_NEAR(cover.share, 0.3, 0.01);
  EXPECT_NEAR(cover.max, 4.5 * edge, 0.1 * edge);
  EXPECT_NEAR(cover.rms, edge * std::sqrt(2 * std::pow(4.5, 3) / 3 / 10), 0.02 * edge);
  EXPECT_NEAR(reach.distance({2.5 * edge, 0, 0}), 2 * edge, 1e-9);
}

// Round the ends of the strip: its own area, an edge along its sides, and a disc of its four corners.
TEST(RibsCover, OfAWidePlaneCountsRoundCorners) {
  const Strip strip(6, 0);
  const targets::TriangleMesh plane = rectangle(20 * edge, 20 * edge);
  const RibsCover cover =
      cover_by(RibsReach(strip.fishbone.structure, strip.state, seen_from_below(plane), 0), plane);
  EXPECT_NEAR(cover.share, (6 + 2 * 6 + 2 + pi) / 400, 0.006);
}

TEST(RibsCover, LeavesTheClearanceOut) {
  const targets::TriangleMesh plane = rectangle(10 * edge, 10 * edge);
  const Strip strip(10, 7);
  const auto share = [&](double clearance) {
    return cover_by(RibsReach(strip.fishbone.structure, strip.state, seen_from_below(plane), clearance),
                    plane)
        .share;
  };
  EXPECT_NEAR(share(7), 0.3, 0.01);
  EXPECT_NEAR(share(0), 0.1 + 0.2 * std::sqrt(1 - 0.49), 0.01);
}

TEST(RibsCover, DoesNotCountWhatLiesBelow) {
  const Strip strip(10, 0);
  targets::TriangleMesh plane = rectangle(10 * edge, 10 * edge);
  for (const Vector3d& p : rectangle(80 * edge, 80 * edge).vertices)
    plane.vertices.push_back(p - Vector3d(0, 0, 50));
  plane.triangles.push_back({4, 5, 6});
  const RibsReach reach(strip.fishbone.structure, strip.state, seen_from_below(plane), 0);
  EXPECT_NEAR(cover_by(reach, plane, -1).share, 0.3, 0.1);
  EXPECT_LE(cover_by(reach, plane).share, 0.03);
}

TEST(RibsCover, ShowsThePartsOfALineThatAreBare) {
  const Strip strip(10, 0);
  const targets::TriangleMesh plane = rectangle(10 * edge, 10 * edge);
  const RibsReach reach(strip.fishbone.structure, strip.state, seen_from_below(plane), 0);
  std::vector<Vector3d> line;
  for (int k = -50; k <= 50; ++k) line.emplace_back(k, 0, 0);
  const auto parts = uncovered_parts(reach, line);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].front().x(), -50);
  EXPECT_EQ(parts[0].back().x(), -16);
  EXPECT_EQ(parts[1].front().x(), 16);
}

double limit_use(const targets::RibbedSurface& surface, int ribs, double edge_mm) {
  RibsSpec spec;
  spec.size = {edge_mm, 0.08 * edge_mm, 0.15 * edge_mm};
  spec.ribs = ribs;
  spec.clearance_mm = 0;
  const RibsDesign design = fit_ribs(surface, spec, {});
  return cover_by(RibsReach(design.fishbone.structure, design.state, surface.surface, 0),
                  surface.surface.mesh())
      .share;
}

TEST(RibsCover, GrowsWithTheNumberOfRibs) {
  for (const targets::RibbedSurface& surface :
       {targets::ribbed_surface(targets::cap_patch(100, 60 * radians_per_degree)),
        targets::ribbed_surface(targets::saddle_patch(100, 0.2))}) {
    const double few = limit_use(surface, 2, 5), more = limit_use(surface, 6, 5);
    EXPECT_LT(few, 0.45);
    EXPECT_GT(more, 0.7);
  }
}

}  // namespace
}  // namespace kinetix::optim
