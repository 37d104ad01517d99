#include <gtest/gtest.h>

#include "benchmarks/peers/differenced_problem.hpp"
#include "benchmarks/peers/simulated_fit.hpp"
#include "optim/curve/fit_curve.hpp"
#include "targets/curve/curve.hpp"
#include "tests/support/curves.hpp"

namespace kinetix::bench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct HalfCircle {
  targets::Curve goal = testing::half_circle();
  int columns = 8;
  optim::CurveFit fit{goal,
                      make_bend_ties(columns, optim::Per::column, optim::Symmetry::none, {-1, 1}),
                      testing::fitting_cell(goal, columns),
                      {0.05, 0.76}};
};

TEST(DifferencedProblem, HasTheSlopesOfTheAnalyticOneInsideAndAtTheBounds) {
  const HalfCircle scene;
  const VectorXd inside = curve_start(scene.fit, 0, 0);
  VectorXd at_bounds = inside;
  at_bounds[0] = scene.fit.upper()[0];
  at_bounds[1] = scene.fit.lower()[1];
  using Differences = DifferencedProblem::Differences;
  for (const auto& [differences, step, tolerance] :
       {std::tuple{Differences::forward, 1e-7, 1e-5}, {Differences::central, 1e-5, 1e-5}})
    for (const VectorXd& x : {inside, at_bounds}) {
      const DifferencedProblem differenced(scene.fit, differences, step);
      VectorXd r(scene.fit.residuals()), same = r;
      MatrixXd exact(scene.fit.residuals(), scene.fit.variables()), J;
      ASSERT_TRUE(scene.fit.evaluate(x, r, &exact));
      ASSERT_TRUE(differenced.evaluate(x, same, &J));
      EXPECT_EQ(r, same);
      EXPECT_LE((J - exact).cwiseAbs().maxCoeff(), tolerance * exact.cwiseAbs().maxCoeff());
    }
}

TEST(SimulatedFit, MeasuresTheShapeThatTheEngineFolds) {
  const HalfCircle scene;
  sim::PhysicsOptions options;
  options.step_s = 1.0 / 60;
  options.joint_stiffness = 1e8;
  const double edge = scene.fit.cell_mm();
  const SimulatedFit simulated(scene.fit, {edge, edge / 10, 0.6 * edge}, options);
  const VectorXd start = curve_start(scene.fit, 0, 0);
  VectorXd r;
  ASSERT_TRUE(simulated.evaluate(start.head(simulated.variables()), r, nullptr));
  EXPECT_EQ(r.size(), simulated.residuals());
  EXPECT_EQ(simulated.runs(), 1);

  const model::ExactDesign<double> design = scene.fit.design(start, 1);
  model::Structure structure =
      make_structure(model::rectangle(scene.columns, 1), {edge, edge / 10, 0.6 * edge});
  apply(design, structure);
  const targets::CurveError exact = curve_error(optim::midline(fold(design, structure), 1), scene.goal);
  ASSERT_EQ(exact.distance_mm.size(), static_cast<std::size_t>(r.size()));
  const Eigen::Map<const VectorXd> distances(exact.distance_mm.data(), r.size());
  const double unit = exact.scale_mm * std::sqrt(static_cast<double>(r.size()));
  EXPECT_GT(r.norm(), 1e-3);
  EXPECT_NEAR(r.norm(), distances.norm() / unit, 1e-6);
}

}  // namespace
}  // namespace kinetix::bench
