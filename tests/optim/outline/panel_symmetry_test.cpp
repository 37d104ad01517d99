#include "optim/outline/panel_symmetry.hpp"

#include <gmock/gmock.h>
#include <cmath>

#include "kinetix/kinetix.hpp"
#include "optim/outline/fit_outline.hpp"
#include "optim/outline/outline_problem.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;

model::PlanarStructure square_panel(int cells) {
  return kinetix::make_planar_structure(kinetix::square_graph(cells, cells),
                                        {.edge_mm = 10, .thickness_mm = 0.8, .height_mm = 6});
}

/// Outline with the radius 30 + size cos(order (angle - tilt)), mm.
targets::Outline wavy(int order, double size, double tilt = 0) {
  std::vector<Vector2d> out;
  for (int k = 0; k < 120; ++k) {
    const double angle = 2 * pi * k / 120, radius = 30 + size * std::cos(order * (angle - tilt));
    out.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return targets::Outline(out);
}

TEST(PanelSymmetry, IsThatOfPanelAndOutline) {
  const model::PlanarStructure square = square_panel(4);
  const auto count = [&](const targets::Outline& outline) {
    return find_symmetries(square, outline, nullptr).size();
  };
  EXPECT_EQ(count(wavy(4, 3)), 7u) << "four turns and four axes, without the identity";
  EXPECT_EQ(count(wavy(2, 3)), 3u);
  EXPECT_EQ(count(wavy(3, 3)), 1u) << "the panel has one of its three axes";
  EXPECT_EQ(count(wavy(2, 3, 0.2)), 1u) << "its axes are not those of the panel, but half a turn is";
  EXPECT_EQ(count(wavy(3, 3, 0.2)), 0u);
  const targets::Outline lopsided = wavy(3, 3, 0.2);
  EXPECT_EQ(find_symmetries(square, wavy(4, 3), &lopsided).size(), 0u);
}

TEST(PanelSymmetry, MeanOfImagesIsSymmetric) {
  const model::PlanarStructure square = square_panel(3);
  const std::vector<PanelSymmetry> symmetries = find_symmetries(square, wavy(4, 3), nullptr);
  std::vector<Vector2d> places = square.graph.vertices;
  places[2] += Vector2d(0.3, 0.1);
  const Vector2d middle(1, 2);
  symmetrise(symmetries, middle, places);
  for (const PanelSymmetry& s : symmetries)
    for (std::size_t v = 0; v < places.size(); ++v)
      EXPECT_LE((middle + s.map * (places[v] - middle) - places[s.vertices[v]]).norm(), 1e-12);
}

TEST(FitOutline, GivesSymmetricPanelsForSymmetricOutlines) {
  const targets::Outline outline = wavy(3, 3);
  const model::PlanarStructure square = square_panel(6);
  const OutlineDesign design = fit_outline(square, outline, nullptr, {});
  const Vector2d middle = outline.middle() / design.scale;
  const std::vector<PanelSymmetry> symmetries = find_symmetries(square, outline, nullptr);
  ASSERT_EQ(symmetries.size(), 1u);
  const std::vector<Vector2d>& places = design.shape.folded;
  for (std::size_t v = 0; v < places.size(); ++v)
    EXPECT_LE((middle + symmetries[0].map * (places[v] - middle) - places[symmetries[0].vertices[v]]).norm(),
              1e-9);
}

TEST(RefinedShape, DeformsAsTheCoarsePanel) {
  const model::PlanarStructure coarse = square_panel(4);
  model::PlanarStructure fine = square_panel(8);
  fine.size.edge_mm = 5;
  OutlineShape shape;
  shape.scale = 12;
  shape.flat = coarse.graph.vertices;
  const Eigen::Matrix2d map = (Eigen::Matrix2d() << 0.8, -0.2, 0.3, 0.7).finished();
  for (const Vector2d& p : shape.flat) shape.folded.push_back(map * p);
  const OutlineShape refined = refined_shape(coarse, shape, fine);
  EXPECT_NEAR(refined.scale, 6, 1e-12);
  for (const model::GraphEdge& e : fine.graph.edges) {
    const Vector2d flat = fine.graph.vertices[e.to] - fine.graph.vertices[e.from];
    EXPECT_LE((refined.flat[e.to] - refined.flat[e.from] - flat).norm(), 1e-12);
    EXPECT_LE((refined.folded[e.to] - refined.folded[e.from] - map * flat).norm(), 1e-12);
  }
}

TEST(RefinedShape, IsAStartOfASearch) {
  const targets::Outline outline = wavy(2, 3);
  const model::PlanarStructure coarse = square_panel(6), fine = square_panel(12);
  const OutlineDesign first = fit_outline(coarse, outline, nullptr, {});
  ASSERT_TRUE(first.clear);
  const OutlineShape start = refined_shape(coarse, first.shape, fine);
  OutlineOptions options;
  options.theta = {first.theta, first.theta};
  options.start = &start;
  const OutlineDesign design = fit_outline(fine, outline, nullptr, options);
  EXPECT_EQ(design.theta, first.theta);
  EXPECT_TRUE(design.clear);
  EXPECT_LE(design.error.rms, 1.02 * first.error.rms);
}

}  // namespace
}  // namespace kinetix::optim
