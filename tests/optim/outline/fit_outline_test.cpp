#include "optim/outline/fit_outline.hpp"

#include <gmock/gmock.h>
#include <cmath>
#include <numbers>

#include "kinetix/kinetix.hpp"
#include "model/lattice/planar/regular_lattices.hpp"

namespace kinetix::optim {
namespace {

/// An ellipse about the origin, as a polygon.
targets::Outline ellipse(double a, double b, int points = 120) {
  std::vector<Eigen::Vector2d> out;
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * std::numbers::pi * k / points;
    out.emplace_back(a * std::cos(angle), b * std::sin(angle));
  }
  return targets::Outline(out);
}

const model::PlanarStructure& panel() {
  static const model::PlanarStructure made = kinetix::make_planar_structure(
      kinetix::square_graph(6, 6), {.edge_mm = 10, .thickness_mm = 0.8, .height_mm = 6});
  return made;
}

/// Returns the corners of the boundary at theta, in the outline's own mm, from the hinges alone.
std::vector<Eigen::Vector2d> folded_boundary(const OutlineDesign& design) {
  const model::ParallelDrawingFit motion = parallel_drawing_of(design.panel);
  EXPECT_LE(motion.misfit, 1e-11) << "every cell closes";
  const model::State state = fold(design.panel, motion.y, design.theta);
  const model::State as_found = fold(design.panel, design.y, design.theta);
  const Eigen::Vector3d shift = as_found[0].p - state[0].p;
  std::vector<Eigen::Vector2d> out;
  for (const int body : outer_boundary(design.panel.graph).vertices) {
    const Eigen::Vector3d p = state[static_cast<std::size_t>(body)].p + shift;
    out.emplace_back((p.head<2>() / design.panel.size.edge_mm - design.origin) * design.scale);
  }
  return out;
}

TEST(FitOutline, MakesTheRimOfASquarePanelRound) {
  const targets::Outline goal = ellipse(30, 30);
  OutlineOptions options;
  const OutlineDesign design = kinetix::fit_outline(panel(), goal, nullptr, options);
  EXPECT_TRUE(design.clear);
  EXPECT_LE(design.error.rms, 0.02);
  EXPECT_GE(design.error.iou, 0.9);
  EXPECT_LE(design.offset, options.offset + 1e-9);
  EXPECT_LE(design.shift, 1 - 2 * options.t[0] + 1e-9);
  EXPECT_GE(design.theta, options.theta[0]);
  EXPECT_LE(design.theta, options.theta[1]);
  const targets::OutlineError reported = outline_error(goal, folded_boundary(design));
  EXPECT_NEAR(reported.rms, design.error.rms, 1e-9);
  EXPECT_NEAR(reported.iou, design.error.iou, 1e-9);
}

TEST(FitOutline, FindsTheSameOnAnyNumberOfThreads) {
  const targets::Outline goal = ellipse(30, 24);
  OutlineOptions options;
  const OutlineDesign alone = kinetix::fit_outline(panel(), goal, nullptr, options);
  for (const int threads : {2, 3, 8}) {
    options.threads = threads;
    const OutlineDesign design = kinetix::fit_outline(panel(), goal, nullptr, options);
    EXPECT_EQ(design.theta, alone.theta);
    EXPECT_EQ(design.error.rms, alone.error.rms);
    EXPECT_EQ(design.rounds, alone.rounds);
    EXPECT_EQ(design.y, alone.y);
  }
}

/// 60 mm x 40 mm, sheared by 12 mm: walls of symmetric panels need not slide.
const targets::Outline& leaning() {
  static const targets::Outline made({{0, 0}, {60, 0}, {72, 40}, {12, 40}});
  return made;
}

/// A panel whose hinges may not sit off their walls, or by less than a search can tell.
void expect_exact_on_walls(const model::PlanarStructure& flat, const targets::Outline* flat_outline,
                           double offset) {
  OutlineOptions options;
  options.offset = offset;
  options.thetas = 1;
  const OutlineDesign design = kinetix::fit_outline(flat, leaning(), flat_outline, options);
  EXPECT_EQ(design.offset, 0);
  EXPECT_GT(design.shift, 0.02) << "hinges slide along their walls";
  EXPECT_LE(design.shift, 1 - 2 * options.t[0] + 1e-9);
  EXPECT_TRUE(exact_motion(design.panel)) << exact_motion(design.panel).why;
  EXPECT_NEAR(outline_error(leaning(), folded_boundary(design)).rms, design.error.rms, 1e-9);
}

TEST(FitOutline, MovesExactlyWithAllHingesOnTheirWalls) {
  for (const double offset : {0.0, 1e-9}) expect_exact_on_walls(panel(), nullptr, offset);
  for (const model::PlanarLattice* lattice :
       {&model::honeycomb_lattice, &model::octagon_lattice, &model::brick_lattice}) {
    SCOPED_TRACE(lattice->name);
    const auto made =
        make_planar_structure(model::LatticeSheet{lattice, model::lattice_cells(3, 3)}, panel().size);
    expect_exact_on_walls(made, nullptr, 0);
  }
}

TEST(FitOutline, MovesExactlyOnItsWallsWithAFlatOutlineToo) {
  const targets::Outline square({{0, 0}, {50, 0}, {50, 50}, {0, 50}});
  expect_exact_on_walls(panel(), &square, 0);
}

TEST(FitOutline, RefusesOptionsOutOfRange) {
  const targets::Outline goal = ellipse(30, 20);
  for (const double wrong : {-0.1, 0.5, std::nan("")}) {
    OutlineOptions options;
    options.offset = wrong;
    EXPECT_THROW(fit_outline(panel(), goal, nullptr, options), InvalidInput) << wrong;
  }
  OutlineOptions options;
  options.theta = {0.7, 0.35};
  EXPECT_THROW(fit_outline(panel(), goal, nullptr, options), InvalidInput);
}

}  // namespace
}  // namespace kinetix::optim
