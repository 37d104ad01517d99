#include "optim/surface/fit_surface.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "model/base/invalid_input.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/origami/origami_sheet.hpp"
#include "optim/surface/surface_problem.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::optim {
namespace {

SurfaceOptions few(int facets, int starts) {
  SurfaceOptions options;
  options.columns = options.rows = facets;
  options.starts = starts;
  return options;
}

TEST(SurfaceProblem, HasTheDerivativesOfItsResiduals) {
  const targets::SurfacePatch cap = targets::cap_patch(100, 1);
  const SurfaceStart start = start_on(cap, 4, 5, {1.0, 1.2, 1, -1});
  const SurfaceProblem problem(cap, start.variables, {}, 0.05);
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  Eigen::VectorXd x = start.x;
  for (int k = 0; k < x.size(); ++k) x[k] += 0.02 * std::sin(3.0 * k);
  ASSERT_TRUE(problem.evaluate(x, r, &J));
  const auto residual = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd out;
    EXPECT_TRUE(problem.evaluate(at, out, nullptr));
    return out;
  };
  testing::expect_jacobian(residual, x, J, 1e-6, 1e-5);
}

TEST(SurfaceStart, IsAsLargeAsItsSurface) {
  const targets::SurfacePatch vase = targets::vase_patch(120, 50, 10, 1);
  const SurfaceStart start = start_on(vase, 6, 8, {});
  const auto vertices = placed_vertices(start.variables, start.x);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : vertices) box.extend(vertex);
  EXPECT_NEAR(box.sizes().x(), 2 * vase.half.x(), 0.25 * vase.half.x());
  EXPECT_NEAR(box.sizes().y(), 2 * vase.half.y(), 0.25 * vase.half.y());
}

TEST(FitSurface, GivesACapWhoseSheetMovesExactly) {
  const SurfaceDesign design = fit_surface(targets::cap_patch(100, 40 * radians_per_degree), few(6, 3));
  EXPECT_TRUE(design.within);
  EXPECT_LE(design.error.rms, 0.012);
  const model::OrigamiSheet sheet = model::origami_sheet(design.mesh, {});
  const model::ExactMotion exact = exact_motion(model::Lattice(sheet.structure));
  ASSERT_TRUE(exact) << exact.why;
  for (const double theta : {0.1, 0.3, 0.5}) {
    const model::State state = fold(sheet, theta);
    EXPECT_LE(hinge_gaps(sheet.structure, state).max, 1e-11);
    EXPECT_LE(aligned_distance(sheet.structure, exact.at(theta), state).max, 1e-10);
  }
}

TEST(FitSurface, FindsTheSameWhateverTheNumberOfThreads) {
  const targets::SurfacePatch saddle = targets::saddle_patch(100, 0.15);
  SurfaceOptions one = few(4, 2), two = one;
  one.threads = 1;
  two.threads = 2;
  one.iterations = two.iterations = 40;
  EXPECT_EQ(fit_surface(saddle, one).error.rms, fit_surface(saddle, two).error.rms);
}

TEST(FitSurface, ShakesGainWhereASheetMisses) {
  const targets::SurfacePatch saddle = targets::saddle_patch(100, 0.3);
  SurfaceOptions options = few(4, 2);
  options.iterations = 60;
  const SurfaceDesign plain = fit_surface(saddle, options);
  EXPECT_EQ(plain.shakes, 0);
  options.shakes = 3;
  options.threads = 1;
  const SurfaceDesign shaken = fit_surface(saddle, options);
  EXPECT_EQ(shaken.shakes, 12);
  EXPECT_LT(shaken.error.rms, plain.error.rms);
  EXPECT_EQ(shaken.within, plain.within);
  EXPECT_GT(shaken.evaluations, plain.evaluations);
  options.threads = 2;
  EXPECT_EQ(fit_surface(saddle, options).error.rms, shaken.error.rms);
  options.enough = plain.error.rms;
  EXPECT_EQ(fit_surface(saddle, options).shakes, 0);
}

TEST(FitSurface, LetsTheBetterHalfOfItsStartsGoOn) {
  const targets::SurfacePatch saddle = targets::saddle_patch(100, 0.15);
  SurfaceOptions options = few(4, 3);
  options.threads = 1;
  options.iterations = 20;
  int reports = 0;
  double done = 0;
  const SurfaceDesign design =
      fit_surface(saddle, options, [&](const std::string&, double share, const std::string&) {
        ++reports;
        done = share;
      });
  EXPECT_EQ(reports, 3 + 2);
  EXPECT_EQ(done, 1);
  EXPECT_EQ(design.starts, 3);
  EXPECT_GT(design.evaluations, 3 * (4 + 10) + 2 * 20);
}

TEST(FitSurface, GoesOnUntilASaddleOfStrongCurvatureIsMet) {
  SurfaceOptions options = few(8, 4);
  options.bounds.edge = {0.3, 3};
  const SurfaceDesign design = fit_surface(targets::saddle_patch(100, 0.3), options);
  EXPECT_TRUE(design.within);
  EXPECT_LE(design.error.rms, 8e-3);
}

/// Creases of such tilts fold by less than the usual least.
TEST(FitSurface, IsSearchedWithinGentleTilts) {
  SurfaceOptions options = few(4, 2);
  options.theta = 0.25;
  options.tilt = 4 * radians_per_degree;
  options.iterations = 60;
  const SurfaceDesign design = fit_surface(targets::cap_patch(100, 5 * radians_per_degree), options);
  EXPECT_GT(design.evaluations, 10);
  ASSERT_TRUE(design.valid);
  EXPECT_LE(design.tilt, options.tilt * (1 + 1e-9));
}

TEST(FitSurface, RefusesOptionsOutOfRange) {
  SurfaceOptions options;
  options.theta = 1;
  EXPECT_THROW(fit_surface(targets::cap_patch(100, 1), options), InvalidInput);
}

}  // namespace
}  // namespace kinetix::optim
