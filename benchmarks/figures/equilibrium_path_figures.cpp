#include <fmt/format.h>
#include <chrono>
#include <cmath>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::bench {
namespace {

constexpr double degree = radians_per_degree;  // rad, so that angles below read in degrees

struct ExactScene {
  const char* name;
  model::Structure structure;
  model::Drive drive;
};

std::vector<ExactScene> exact_scenes() {
  return {{"planar grid", testing::crossable_grid(),
           testing::hinge_drive(testing::crossable_grid(), {{0, 0}, model::Axis::y}, 25 * degree)},
          {"bending strip", testing::bending_strip(), testing::plates_drive(model::Axis::y, 25 * degree)},
          {"bending sheet", testing::bending_sheet(),
           testing::hinge_drive(testing::bending_sheet(), {{0, 0}, model::Axis::y}, 25 * degree)}};
}

/// Returns the distance from the closed form, cell edges, rms; infinite if the path does not end at its goal.
double from_closed_form(const ExactScene& scene, double ratio) {
  const model::Structure& s = scene.structure;
  model::Elasticity elasticity;
  elasticity.k_turn = ratio * energy_unit(elasticity, s.size.edge_mm);
  const model::EquilibriumPath path =
      trace_equilibrium(driven(s, scene.drive), elasticity, testing::without_contact());
  if (path.stop != model::EquilibriumPath::Stop::reached) return INFINITY;
  return aligned_distance(s, path.state, fold(classify(s), s, path.theta)).rms;
}

Figure closed_form_distance() {
  std::string measured;
  bool met = true;
  for (const ExactScene& scene : exact_scenes()) {
    const double soft = from_closed_form(scene, 1e-6), softer = from_closed_form(scene, 1e-8),
                 lowest_mode = from_closed_form(scene, 1e-12);
    const double order = std::log10(soft / softer) / 2;
    met = met && lowest_mode <= 1e-8 && std::abs(order - 1) <= 0.05;
    measured += fmt::format("{}{} {:.1e}, order {:.2f}", measured.empty() ? "" : "; ", scene.name,
                            lowest_mode, order);
  }
  return {
      "distance of the equilibrium from the closed form at stiffness ratio 1e-12, and its order in the ratio "
      "(1e-6 to 1e-8)",
      "<= 1e-8 cell edges, first order", measured, met};
}

struct Followed {
  double seconds = 0;
  int bodies = 0;
  model::EquilibriumPath path;
  double given_up = 0;  ///< theta at which the time was over, rad; 0 where it was not
};

struct TimeIsOver {
  double theta;
};

/// Follows a path and returns median times. A path that takes six times the allowed time is given up.
Followed followed(const model::Structure& s, const model::Drive& drive, int repeats, double allowed) {
  Followed run;
  run.bodies = static_cast<int>(s.bodies.size());
  run.seconds = median_seconds(repeats, 1, [&] {
    const auto start = std::chrono::steady_clock::now();
    const auto watch = [&](const model::EquilibriumStep& step, const model::State&) {
      const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - start;
      if (so_far.count() > 6 * allowed) throw TimeIsOver{step.theta};
    };
    try {
      run.path = trace_equilibrium(driven(s, drive), {}, {}, watch);
    } catch (const TimeIsOver& over) {
      run.given_up = over.theta;
    }
  });
  return run;
}

Figure timed(const std::string& what, const Followed& run, double allowed) {
  Figure figure{what, fmt::format("<= {:g} s", allowed), {}, false};
  if (run.given_up != 0) {
    figure.measured = fmt::format("given up at theta {:.2f} after {:.3g} s", run.given_up, run.seconds);
    return figure;
  }
  figure.measured = fmt::format("{:.3g} s, {} in {} steps of {} Newton iterations", run.seconds,
                                to_string(run.path.stop), run.path.steps.size() - 1, run.path.iterations);
  figure.met = run.path.stop == model::EquilibriumPath::Stop::reached && run.seconds <= allowed;
  return figure;
}

std::vector<Figure> letters() {
  const model::Plates drive{.compression = 0.16};
  const auto run = [&](int cells, int repeats, double allowed) {
    return followed(testing::letter_panel(0.1, cells), drive, repeats, allowed);
  };
  const Followed small = run(10, 9, 0.05), middle = run(32, 3, 1), large = run(100, 1, 10);
  const auto name = [](int cells) {
    return fmt::format("letter T in {0} x {0} cells, flat to 16 % between plates, walls in contact", cells);
  };
  const double growth =
      std::log(middle.seconds / small.seconds) / std::log(static_cast<double>(middle.bodies) / small.bodies);
  return {timed(name(10), small, 0.05),
          timed(name(32), middle, 1),
          timed(name(100), large, 10),
          {"growth of that time with the bodies, 10 x 10 to 32 x 32", "exponent <= 1.2",
           fmt::format("{:.2f}", growth), growth <= 1.2 && large.given_up == 0}};
}

Figure sheet() {
  const model::Structure s = testing::alternating(10, 10, testing::bending_unit, testing::twisting_unit);
  return timed("sheet of 10 x 10 cells that bend and twist, flat to theta 0.6 between plates",
               followed(s, testing::plates_drive(model::Axis::y, 0.6), 5, 0.5), 0.5);
}

}  // namespace

std::vector<Figure> equilibrium_path_figures() {
  std::vector<Figure> figures = {closed_form_distance()};
  for (Figure& figure : letters()) figures.push_back(std::move(figure));
  figures.push_back(sheet());
  return figures;
}

}  // namespace kinetix::bench
