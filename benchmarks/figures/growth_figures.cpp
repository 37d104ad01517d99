#include <fmt/format.h>
#include <cmath>
#include <functional>

#include "benchmarks/alone.hpp"
#include "benchmarks/figure.hpp"
#include "benchmarks/scenes.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/planar/exact_designs.hpp"
#include "model/lattice/planar/regular_lattices.hpp"
#include "sim/physics_run.hpp"

namespace kinetix::bench {
namespace {

constexpr double closed = 1e-11;              // cell edges: that of small scenes is rounding, and less
constexpr double closure_per_column = 1e-15;  // cell edges: places far from the first body round by so much
constexpr double min_scene_bytes =
    32 << 20;                         // bytes: of less, most is no scene, and says nothing of what GiB hold
constexpr int max_seconds = 60;       // of a run: eight scenes of it stay within a quarter of an hour
constexpr double small_theta = 0.02;  // rad of theta, in few steps: large sheets take a minute for each

/// Scene of growing size, with the cost of one run per size, each in a separate process.
struct Growth {
  std::vector<double> cells, seconds, bytes;
  bool right = true;    ///< every run ended as it should
  double given_up = 0;  ///< cells of the first run beyond the time or memory; 0 if there is none
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

/// Returns the slope without the first size: the time of small scenes is the start of a run.
double slope(const Growth& growth, const std::vector<double>& of) {
  return exponent({growth.cells.begin() + 1, growth.cells.end()}, {of.begin() + 1, of.end()});
}

/// Returns the number of cells whose run needs `bytes`, as memory grows at the end.
double most_cells(const Growth& growth, double bytes) {
  return growth.cells.back() * std::pow(bytes / growth.bytes.back(), 1 / slope(growth, growth.bytes));
}

Figure grown(const std::string& what, const Growth& growth) {
  if (growth.cells.size() < 3) return {what, "-", "fewer than three sizes ended", false};
  std::string measured = fmt::format(
      "time to the {:.2f}, memory to the {:.2f} of the cells; {:.3g} cells: {:.3g} ms; {:.3g} cells: {:.3g} "
      "s, {:.3g} GiB",
      slope(growth, growth.seconds), slope(growth, growth.bytes), growth.cells.front(),
      1e3 * growth.seconds.front(), growth.cells.back(), growth.seconds.back(), growth.bytes.back() / gib);
  if (growth.bytes.back() >= min_scene_bytes)
    measured += fmt::format("; 24 GiB hold {:.1g} cells", most_cells(growth, 24 * gib));
  if (growth.given_up > 0)
    measured += fmt::format("; {:.1g} cells given up after {} s", growth.given_up, max_seconds);
  return {what, "-", measured, growth.right};
}

/// Runs sizes in turn until one is given up. @param cells of each
Growth over(const std::vector<int>& cells, const std::function<Cost(int)>& run) {
  Growth growth;
  for (const int n : cells) {
    const auto cost = cost_alone([&] { return run(n); }, max_seconds);
    if (!cost) {
      growth.given_up = n;
      break;
    }
    growth.cells.push_back(n);
    growth.seconds.push_back(cost->cost.seconds);
    growth.bytes.push_back(cost->bytes);
    growth.right = growth.right && cost->cost.right;
  }
  return growth;
}

/// Columns and rows of a scene.
using Shape = std::pair<int, int>;
Shape a_strip(int cells) { return {cells, 1}; }
Shape a_sheet(int cells) {
  const int edge = static_cast<int>(std::lround(std::sqrt(cells)));
  return {edge, edge};
}

int repeats(int cells) { return cells > 2000 ? 1 : 3; }

Cost exact_model(const Shape& shape) {
  model::ExactDesign<double> design;
  const model::Structure structure = arc(shape.first, shape.second, design);
  model::State poses;
  const int calls = std::max(1, 200000 / static_cast<int>(structure.bodies.size()));
  const double time = median_seconds(5, calls, [&] { fold(design, 10.0, poses); });
  return {time, hinge_gaps(structure, poses).max < closed + shape.first * closure_per_column};
}

Cost planar_designs(int cells) {
  const int edge = a_sheet(cells).first;
  const model::PlanarStructure hexagons =
      model::make_planar_structure(model::lattice_graph(model::honeycomb_lattice, edge, edge), {});
  int numbers = 0;
  const double time =
      median_seconds(repeats(cells), 1, [&] { numbers = model::ExactDesigns(hexagons).dimension(); });
  return {time,
          numbers == static_cast<int>(hexagons.senses.size() - hexagons.faces.size()) - 1};  // V - F - 1
}

Cost equilibrium(const Shape& shape) {
  model::ExactDesign<double> design;
  const model::Structure structure = arc(shape.first, shape.second, design);
  model::EquilibriumPath path;
  const double time = median_seconds(repeats(shape.first * shape.second), 1, [&] {
    path = trace_equilibrium(driven(structure, drive_to(structure, design.theta)), {}, {});
  });
  return {time, path.stop == model::EquilibriumPath::Stop::reached};
}

/// Measures a step of the physics run.
Cost physics_run(const Shape& shape) {
  model::ExactDesign<double> design;
  const model::Structure structure = arc(shape.first, shape.second, design);
  sim::PhysicsOptions options;
  options.step_s = 1.0 / 100;
  options.drive_seconds = 0.1;
  options.settle_seconds = 0.02;
  options.joint_stiffness =
      1e8;  // as the program takes for what closes exactly: long strips sway behind softer ones
  std::vector<double> times;
  bool right = true;
  for (int k = 0; k < repeats(shape.first * shape.second); ++k) {
    const sim::PhysicsResult run =
        run_compression(structure, drive_on(structure, drive_to(structure, small_theta)), options);
    times.push_back(run.seconds / run.steps);
    right = right && run.gaps.max < 2e-3;
  }
  return {median(times), right};
}

Cost search(int columns) {
  optim::MultiStartOptions options;
  options.threads = 1;
  const Scene scene = regression_scenes().front();
  const optim::CurveVariables variables = strip(scene, columns);
  bool right = true;
  const double time = median_seconds(repeats(columns), 1, [&] {
    right = right && std::isfinite(fit_curve(scene.goal, variables, options).error.rms);
  });
  return {time, right};
}

}  // namespace

std::vector<Figure> growth_figures() {
  const std::vector<int> decades = {100, 1000, 10000, 100000, 1000000};
  const auto on = [](Shape (*shape)(int), Cost (*run)(const Shape&)) {
    return [=](int cells) { return run(shape(cells)); };
  };
  return {grown("exact model, strips: growth", over(decades, on(a_strip, exact_model))),
          grown("exact model, sheets: growth", over(decades, on(a_sheet, exact_model))),
          grown("planar, null space of hexagons: growth", over(decades, planar_designs)),
          grown("search for a half circle, 8 starts: growth", over({10, 30, 100, 200, 400}, search)),
          grown("equilibrium, strips that bend, flat to theta 0.5: growth",
                over({20, 80, 320, 1280}, on(a_strip, equilibrium))),
          grown("equilibrium, sheets that bend, flat to theta 0.5: growth",
                over(decades, on(a_sheet, equilibrium))),
          grown("physics run, strips, a step: growth", over(decades, on(a_strip, physics_run))),
          grown("physics run, sheets, a step: growth", over(decades, on(a_sheet, physics_run)))};
}

}  // namespace kinetix::bench
