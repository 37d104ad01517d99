#include <fmt/format.h>
#include <fmt/ranges.h>

#include "benchmarks/figure.hpp"
#include "tests/support/linkages.hpp"

namespace kinetix::bench {
namespace {

using testing::Mechanism;
using testing::MechanismRun;

constexpr double step_ratio = 10;  // times: each list of steps below goes from a step to a tenth of it

/// Computes the order of a quantity in the step, from the last two steps.
double order(const std::vector<double>& values) {
  return std::log(values[values.size() - 2] / values.back()) / std::log(step_ratio);
}

std::string listed(const std::vector<double>& values) {
  return fmt::format("{:.1e} (order {:.1f})", fmt::join(values, ", "), order(values));
}

/// Drift of the energy, largest hinge gap and distance from what is known, against the step.
Figure against_step(const Mechanism& mechanism, const std::vector<double>& steps) {
  std::vector<double> drifts, gaps, violations, inverse;
  double time = 0;
  for (const double step : steps) {
    testing::FreeLinkageOptions options;
    options.step_s = step;
    const MechanismRun run = testing::run_mechanism(mechanism, options);
    drifts.push_back(run.drift);
    gaps.push_back(run.result.gap.point);
    violations.push_back(run.miss);
    inverse.push_back(1 / step);
    time = run.result.seconds;
  }
  return {fmt::format("{}, {} bodies, {} s of motion at steps of 1/{} s", mechanism.name,
                      mechanism.linkage.bodies.size(), mechanism.seconds, fmt::join(inverse, ", 1/")),
          "energy first order, closure second",
          fmt::format("energy drift {}; hinge gap {} m; {}: off by {}; {:.2g} s at the finest",
                      listed(drifts), listed(gaps), mechanism.relation, listed(violations), time),
          order(drifts) >= 0.9 && order(gaps) >= 1.8 && order(violations) >= 0.9};
}

}  // namespace

std::vector<Figure> mechanism_figures() {
  const std::vector<double> fine = {1e-2, 1e-3, 1e-4}, coarse = {1e-2, 1e-3};
  return {against_step(testing::four_bars(1), fine),    against_step(testing::four_bars(4), fine),
          against_step(testing::four_bars(40), coarse), against_step(testing::bricard(), fine),
          against_step(testing::bennett(), fine),       against_step(testing::mirrored_unit(), fine)};
}

}  // namespace kinetix::bench
