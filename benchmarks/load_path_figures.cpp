#include <fmt/format.h>

#include <cmath>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/classify.hpp"
#include "model/elastic/load_path.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::bench {
namespace {

constexpr double degree = radians_per_degree;

struct ExactScene {
  const char* name;
  Structure structure;
  Drive drive;
};

std::vector<ExactScene> exact_scenes() {
  const auto hinge = [](Structure s) {
    const Drive drive = testing::hinge_drive({{0, 0}, Axis::y}, 25 * degree);
    return std::pair{std::move(s), drive};
  };
  const auto [grid, by_hinge] = hinge(testing::crossable_grid());
  return {{"planar", grid, by_hinge},
          {"strip", testing::bending_strip(), testing::plates_drive(Axis::y, 25 * degree)},
          {"sheet", testing::curling_sheet(), testing::plates_drive(Axis::y, 25 * degree)}};
}

/// Cell edges, rms; infinite where the path does not end at its goal.
double from_closed_form(const ExactScene& scene, double ratio) {
  const Structure& s = scene.structure;
  Elasticity elasticity;
  elasticity.k_turn = ratio * elasticity.k_point * s.size.edge_mm * s.size.edge_mm;
  const LoadPath path = follow_load(s, elasticity, scene.drive, testing::without_contact());
  if (path.stop != LoadPath::Stop::reached) return INFINITY;
  return aligned_distance(s, path.state, fold(classify(s), s, path.theta)).rms;
}

Figure closed_form_distance() {
  std::string measured;
  bool met = true;
  for (const ExactScene& scene : exact_scenes()) {
    const double soft = from_closed_form(scene, 1e-6), softer = from_closed_form(scene, 1e-8),
                 softest = from_closed_form(scene, 1e-10);
    const double order = std::log10(soft / softer) / 2;
    met = met && softest <= 1e-8 && std::abs(order - 1) <= 0.05;
    measured += fmt::format("{}{} {:.1e}, order {:.2f}", measured.empty() ? "" : "; ", scene.name, softest, order);
  }
  return {"distance of the equilibrium from the closed form at stiffness ratio 1e-10, and its order in the ratio",
          "<= 1e-8 cell edges, first order", measured, met};
}

struct Followed {
  double seconds = 0;
  int bodies = 0;
  LoadPath path;
};

Followed followed(const Structure& s, const Drive& drive, int repeats) {
  Followed run;
  run.bodies = static_cast<int>(s.bodies.size());
  run.seconds = median_seconds(repeats, 1, [&] { run.path = follow_load(s, {}, drive); });
  return run;
}

Figure timed(const std::string& what, const Followed& run, double allowed) {
  const bool reached = run.path.stop == LoadPath::Stop::reached;
  return {what, fmt::format("<= {:g} s", allowed),
          fmt::format("{:.3g} s, {} in {} steps of {} Newton iterations", run.seconds, to_string(run.path.stop),
                      run.path.steps.size() - 1, run.path.iterations),
          reached && run.seconds <= allowed};
}

std::vector<Figure> letters() {
  Drive drive;
  drive.compression = 0.16;
  const auto run = [&](int cells, int repeats) {
    return followed(testing::letter_panel(0.1, cells), drive, repeats);
  };
  const Followed small = run(10, 9), middle = run(32, 3), large = run(100, 1);
  const auto name = [](int cells) {
    return fmt::format("letter T in {0} x {0} cells, flat to 16 % between plates, walls in contact", cells);
  };
  const auto exponent = [](const Followed& a, const Followed& b) {
    return std::log(b.seconds / a.seconds) / std::log(static_cast<double>(b.bodies) / a.bodies);
  };
  const double growth = exponent(small, large);
  return {timed(name(10), small, 0.05), timed(name(32), middle, 1), timed(name(100), large, 20),
          {"growth of that time with the bodies, 10 x 10 to 100 x 100 (and its two halves)", "exponent <= 1.4",
           fmt::format("{:.2f} ({:.2f}, {:.2f})", growth, exponent(small, middle), exponent(middle, large)),
           growth <= 1.4}};
}

Figure sheet() {
  const Structure s = testing::alternating(10, 10, testing::bending_unit, testing::twisting_unit);
  return timed("sheet of 10 x 10 cells that bend and twist, flat to theta 0.6 between plates",
               followed(s, testing::plates_drive(Axis::y, 0.6), 5), 0.5);
}

}  // namespace

std::vector<Figure> load_path_figures() {
  std::vector<Figure> figures = {closed_form_distance()};
  for (Figure& figure : letters()) figures.push_back(std::move(figure));
  figures.push_back(sheet());
  return figures;
}

}  // namespace kinetix::bench
