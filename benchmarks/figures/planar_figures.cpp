#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/lattice/planar/exact_designs.hpp"
#include "optim/display/wall_scales.hpp"
#include "tests/support/planar_graphs.hpp"

namespace kinetix::bench {
namespace {

using Eigen::Vector2d;
using model::ParallelDrawing;
using model::PlanarGraph;
using model::PlanarStructure;

constexpr double spread = 0.5;  // of s and 2 o: hinges anywhere about the middle of their walls
constexpr unsigned seed = 1;    // any: another gives the same orders of magnitude

struct NamedGraph {
  const char* name;
  PlanarGraph graph;
};

std::vector<NamedGraph> graphs(int cells) {
  return {{"squares", model::square_graph(cells, cells)},
          {"disc of squares", testing::disc_of_squares(cells)},
          {"rhombi of 70 deg",
           model::lattice_graph(model::rhombus_lattice, cells, cells, 70 * radians_per_degree)},
          {"random quads", testing::random_quads(cells, seed)},
          {"honeycomb", model::lattice_graph(model::honeycomb_lattice, cells, cells)},
          {"bricks", model::lattice_graph(model::brick_lattice, cells, cells)},
          {"octagons and squares", model::lattice_graph(model::octagon_lattice, cells, cells)}};
}

/// Largest hinge gap from flat to 86 deg, cell edges.
double largest_gap(PlanarStructure& s) {
  place_hinges(testing::random_redrawing(s, spread, seed), s);
  const model::ExactMotion motion = exact_motion(s);
  if (!motion) return INFINITY;
  const model::Linkage linkage = s;
  double gap = 0;
  for (const double theta : {-1.0, 0.1, 0.5, 1.0, 1.5})
    gap = std::max(gap, hinge_gaps(linkage, motion.at(theta)).max);
  return gap;
}

std::vector<Figure> closure_figures() {
  constexpr int cells = 100;  // each way
  std::vector<Figure> figures;
  for (NamedGraph& g : graphs(cells)) {
    PlanarStructure s = make_planar_structure(std::move(g.graph), {});
    const double gap = largest_gap(s);
    figures.push_back({fmt::format("planar, {} x {} {}: hinges closed at any theta", cells, cells, g.name),
                       "<= 1e-12 cell edges",
                       fmt::format("{:.1e} ({} bodies, {} hinges)", gap, s.senses.size(), s.hinges.size()),
                       gap <= 1e-12});
  }
  return figures;
}

std::vector<Figure> time_figures() {
  PlanarStructure s =
      model::make_planar_structure(model::lattice_graph(model::honeycomb_lattice, 100, 100), {});
  place_hinges(testing::random_redrawing(s, spread, seed), s);
  const double check = median_seconds(5, 1, [&] { exact_motion(s); });
  const ParallelDrawing y = parallel_drawing_of(s).y;
  const double state = median_seconds(9, 3, [&] { fold(s, y, 0.5); });
  int numbers = 0;
  const double null_space = median_seconds(5, 1, [&] { numbers = model::ExactDesigns(s).dimension(); });
  const int expected = static_cast<int>(s.senses.size() - s.faces.size()) - 1;  // V - F - 1
  return {
      {"planar, 100 x 100 hexagons: null space of its closing conditions", "<= 1 s",
       fmt::format("{:.2f} s, {} dimensions", null_space, numbers), null_space <= 1 && numbers == expected},
      {"planar, 100 x 100 hexagons: whether its hinges close, and its motion", "<= 1 s",
       fmt::format("{:.3f} s", check), check <= 1},
      {"planar, 100 x 100 hexagons: one state", "<= 2 ms", fmt::format("{:.2f} ms", 1e3 * state),
       state <= 2e-3}};
}

/// Returns the level of a letter T, of random bits, or of a ramp of greys under a ripple.
double level(const std::string& kind, double x, double y, std::mt19937& random) {
  if (kind == "letter T") {
    const bool bar = y > 0.67 && y < 0.92 && x > 0.08 && x < 0.92;
    return bar || (y > 0.08 && y <= 0.67 && std::abs(x - 0.5) < 0.17) ? 1 : 0;
  }
  if (kind == "bits") return static_cast<double>(random() % 2);
  return std::clamp(0.5 * (x + y) + 0.3 * std::sin(15 * x) * std::sin(15 * y), 0.0, 1.0);
}

Figure picture_figure(const std::string& kind, int cells, double max_seconds) {
  const PlanarStructure s = model::make_planar_structure(model::square_graph(cells, cells), {});
  std::mt19937 random(seed);
  std::vector<double> levels;
  for (const model::GraphFace& face : s.faces) {
    Vector2d middle = Vector2d::Zero();
    for (const int v : face.vertices) middle += s.graph.vertices[v] / (4.0 * cells);
    levels.push_back(level(kind, middle.x(), middle.y(), random));
  }
  const optim::WallScales scales{.wanted = optim::wanted_scales(levels, s, 0.08),
                                 .straight = testing::boundary_rows(s.graph)};
  optim::ScaledWalls found;
  const double time = median_seconds(3, 1, [&] { found = scale_walls(s, scales); });
  return {fmt::format("planar, {} of {} x {} cells, rows straight: search", kind, cells, cells),
          fmt::format("<= {} s", max_seconds),
          fmt::format("{:.3f} s, {} iterations{}", time, found.iterations,
                      found.converged ? "" : ", not converged"),
          time <= max_seconds && found.converged};
}

}  // namespace

std::vector<Figure> planar_figures() {
  std::vector<Figure> figures = closure_figures();
  for (Figure& f : time_figures()) figures.push_back(std::move(f));
  figures.push_back(picture_figure("letter T", 12, 0.2));
  figures.push_back(picture_figure("bits", 29, 1));
  figures.push_back(picture_figure("grey levels", 100, 10));
  return figures;
}

}  // namespace kinetix::bench
