#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "benchmarks/figure.hpp"
#include "benchmarks/scenes.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/square/family/drive.hpp"
#include "sim/compression_run.hpp"

namespace kinetix::bench {
namespace {

/// A scene of growing size and what one run of it took.
struct Growth {
  std::vector<double> cells, hinges, seconds;
  bool right = true;  ///< every run ended as it should

  void add(const model::Structure& structure, double time) {
    cells.push_back(static_cast<double>(structure.cells.size()));
    hinges.push_back(static_cast<double>(structure.hinges.size()));
    seconds.push_back(time);
  }
};

/// Slope of the least-squares line through the logarithms.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double u = std::log(x[k]), v = std::log(y[k]);
    sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

Figure grown(const std::string& what, const Growth& growth) {
  return {
      what + ": growth of the time", "-",
      fmt::format(
          "with the cells to the {:.2f}, with the hinges to the {:.2f} ({:.0f} to {:.0f} cells, {:.3g} to "
          "{:.3g} ms)",
          exponent(growth.cells, growth.seconds), exponent(growth.hinges, growth.seconds),
          growth.cells.front(), growth.cells.back(), 1e3 * growth.seconds.front(),
          1e3 * growth.seconds.back()),
      growth.right};
}

/// Columns and rows of a scene of size n.
using Shape = std::function<std::pair<int, int>(int)>;
std::pair<int, int> a_strip(int n) { return {n, 1}; }
std::pair<int, int> a_sheet(int n) { return {n, n}; }

/// What a run of a scene took, s, and whether it ended as it should.
struct Cost {
  double seconds = 0;
  bool right = true;
};
using Measure = std::function<Cost(const model::Structure&, const model::ExactDesign<double>&)>;

/// Of arcs of growing size.
Growth over(const std::vector<int>& sizes, const Shape& shape, const Measure& measure) {
  Growth growth;
  for (const int n : sizes) {
    model::ExactDesign<double> design;
    const auto [columns, rows] = shape(n);
    const model::Structure structure = arc(columns, rows, design);
    const Cost cost = measure(structure, design);
    growth.add(structure, cost.seconds);
    growth.right = growth.right && cost.right;
  }
  return growth;
}

Cost exact_model(const model::Structure& structure, const model::ExactDesign<double>& design) {
  model::State poses;
  const int calls = std::max(1, 200000 / static_cast<int>(structure.bodies.size()));
  const double time = median_seconds(5, calls, [&] { fold(design, 10.0, poses); });
  return {time, hinge_gaps(structure, poses).max < 1e-11};
}

Cost equilibrium(const model::Structure& structure, const model::ExactDesign<double>& design) {
  model::EquilibriumPath path;
  const double time = median_seconds(
      3, 1, [&] { path = trace_equilibrium(driven(structure, drive_to(structure, design.theta)), {}, {}); });
  return {time, path.stop == model::EquilibriumPath::Stop::reached};
}

/// A step of it.
Cost physics_run(const model::Structure& structure, const model::ExactDesign<double>& design) {
  sim::PhysicsOptions options;
  options.step_s = 1.0 / 100;
  options.settle_seconds = 0.2;
  sim::PhysicsResult run;
  const double time = median_seconds(3, 1, [&] {
    run = run_compression(structure, drive_to(structure, design.theta).on(structure), options);
  });
  return {time / run.steps, run.gaps.max < 2e-3};
}

Growth of_search(const std::vector<int>& sizes) {
  Growth growth;
  optim::MultiStartOptions options;
  options.threads = 1;
  const Scene scene = regression_scenes().front();
  for (const int n : sizes) {
    const optim::CurveVariables variables = strip(scene, n);
    growth.add(make_structure(model::rectangle(n, 1), {}),
               median_seconds(3, 1, [&] { fit_curve(scene.goal, variables, options); }));
  }
  return growth;
}

}  // namespace

std::vector<Figure> growth_figures() {
  return {
      grown("exact model, strips", over({10, 40, 160, 640, 2560, 10240}, a_strip, exact_model)),
      grown("exact model, sheets", over({5, 10, 20, 50, 100}, a_sheet, exact_model)),
      grown("search for a half circle, 8 starts", of_search({10, 20, 40, 80, 160})),
      grown("equilibrium, strips that bend, flat to theta 0.5", over({10, 20, 40, 80}, a_strip, equilibrium)),
      grown("equilibrium, sheets that bend, flat to theta 0.5", over({5, 10, 20, 30}, a_sheet, equilibrium)),
      grown("physics run, strips, a step", over({10, 20, 40, 80, 160}, a_strip, physics_run)),
      grown("physics run, sheets, a step", over({5, 10, 20, 30}, a_sheet, physics_run))};
}

}  // namespace kinetix::bench
