#include <benchmark/benchmark.h>

#include "model/lattice/square/family/exact_derivatives.hpp"
#include "optim/curve/fit_curve.hpp"
#include "targets/curve/curve.hpp"
#include "tests/support/curves.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::bench {
namespace {

model::ExactDesign<double> strip(const benchmark::State& run) {
  std::mt19937 random(2);
  return testing::random_design(model::Family::F3, static_cast<int>(run.range(0)), 1, random);
}

void Fold(benchmark::State& run) {
  const auto design = strip(run);
  model::State poses;
  for (auto _ : run) {
    fold(design, 8.0, poses);
    benchmark::DoNotOptimize(poses.data());
  }
}

void FoldWithJacobian(benchmark::State& run) {
  const auto design = strip(run);
  model::State poses;
  model::ExactJacobian jacobian;
  for (auto _ : run) {
    fold_with_jacobian(design, 8.0, poses, jacobian);
    benchmark::DoNotOptimize(poses.data());
  }
}

void CurveResiduals(benchmark::State& run) {
  const int columns = static_cast<int>(run.range(0));
  const targets::Curve goal = testing::half_circle();
  const optim::CurveFit fit(goal, make_bend_ties(columns, optim::Per::column, optim::Symmetry::none, {-1, 1}),
                            testing::fitting_cell(goal, columns), {0.05, 0.76});
  const Eigen::VectorXd x = curve_start(fit, 0, 0);
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  for (auto _ : run) {
    fit.evaluate(x, r, &J);
    benchmark::DoNotOptimize(r.data());
  }
}

void CurveErrorOfAPolygon(benchmark::State& run) {
  const targets::Curve goal = testing::half_circle();
  const auto midline = testing::half_circle(100, static_cast<int>(run.range(0)) + 1).points();
  for (auto _ : run) benchmark::DoNotOptimize(curve_error(midline, goal).rms);
}

BENCHMARK(Fold)->Arg(10)->Arg(40)->Arg(160);
BENCHMARK(FoldWithJacobian)->Arg(10)->Arg(40)->Arg(160);
BENCHMARK(CurveResiduals)->Arg(10)->Arg(40)->Arg(80);
BENCHMARK(CurveErrorOfAPolygon)->Arg(10)->Arg(40)->Arg(80)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kinetix::bench

BENCHMARK_MAIN();
